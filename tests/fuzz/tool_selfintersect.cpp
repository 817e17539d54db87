#include "tool.hpp"
#include <treeform/tf.hpp>

#include <array>

std::span<const tf::fuzz::tool_command> tf::fuzz::tool_commands() {
    static constexpr std::array<tool_command, 9> all{{
        {"@in -r @report.json --pairs @pairs.csv --curves @curves.obj --touching"},
        {"@in -o @out.ply --html @page.html --png @p.png --png-size 320x240 --within"},
        {"@in --tile-faces 9 --work @tiles -r @report.json --pairs @pairs.csv"},
        {"@in -o @out.glb --vertices equal --curves @curves.ply"},
        {"@in --repair=outer -o @out.ply -r @report.json --curves @curves.obj",
         kept_promise::solid},
        {"@in --repair=outer -o @out.obj --keep-components", kept_promise::solid},
        {"@in --repair=split -o @out.stl --precision float", kept_promise::clean},
        {"@in --repair=remove -o @out.off -r @report.json"},
        {"@in --repair=remove -o @out.glb --touching --html @page.html", kept_promise::clean},
    }};
    return all;
}
