#include "tool.hpp"
#include <treeform/tf.hpp>

#include <array>

std::span<const tf::fuzz::tool_command> tf::fuzz::tool_commands() {
    static constexpr std::array<tool_command, 9> all{{
        {"@in -o @out.ply -r @report.json --html @page.html", kept_promise::solid},
        {"@in -o @out.stl --accept-loss", kept_promise::solid},
        {"@in -o @out.obj --gap 1% --strays 50% --max-loss 100%", kept_promise::solids},
        {"@in -o @out.3mf --fill-rule nonzero --accept-loss -r @report.json", kept_promise::solids},
        {"@in -o @out.off --sheet --accept-loss", kept_promise::clean},
        {"@in -o @out.glb --fill-rule even-odd --no-join --holes 10", kept_promise::solid},
        {"@in -o @out.ply --source from --no-orient --no-detach", kept_promise::solid},
        {"@in --wrap 15% -o @out.stl -r @report.json", kept_promise::solid},
        {"@in --check --html @page.html --png @p.png --png-size 64x48 --view all --curves "
         "@curves.ply"},
    }};
    return all;
}
