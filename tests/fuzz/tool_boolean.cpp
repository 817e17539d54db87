#include "tool.hpp"
#include <treeform/tf.hpp>

#include <array>

std::span<const tf::fuzz::tool_command> tf::fuzz::tool_commands() {
    static constexpr std::array<tool_command, 8> all{{
        {"union @in @other -o @out.ply -r @report.json --html @page.html", kept_promise::solid},
        {"intersection @other @in -o @out.obj --curves @curves.ply", kept_promise::solid},
        {"difference @in @other -o @out.off --merge-coplanar", kept_promise::solid},
        {"difference @other @in -o @out.stl --precision float -r @report.json",
         kept_promise::solid},
        {"symmetric-difference @in @other -o @out.ply --fill-rule even-odd --no-attributes",
         kept_promise::solid},
        {"split @in @other -o @out.glb --html @page.html --png @p.png --png-size 64x48",
         kept_promise::clean},
        {"intersection @in @other --accept-open -o @out.ply -r @report.json"},
        {"union @in -o @out.ply --fill-rule positive --precision float", kept_promise::solid},
    }};
    return all;
}
