#include "tool.hpp"
#include <treeform/tf.hpp>

#include <array>

std::span<const tf::fuzz::tool_command> tf::fuzz::tool_commands() {
    static constexpr std::array<tool_command, 12> all{{
        {"drop @in -o @out.ply --matrix @matrix.txt"},
        {"drop @in --fixed @other -o @out.stl --precision float -r @report.json"},
        {"lay @in -o @out.obj"},
        {"slide @in --fixed @other -d 1,0.5,0 --clearance 0.01 --png @p.png --png-size 64x48"},
        {"mate @other --fixed @in -o @out.off --matrix @matrix.txt"},
        {"separate @in --fixed @other -o @out.ply -r @report.json"},
        {"pack @in @other -o @out.ply --size 100,100 --html @page.html"},
        {"align @in --fixed @other -o @out.xyz --matrix @matrix.txt"},
        {"measure @in --fixed @other --html @page.html -r @report.json"},
        {"clash @in @other -o @out.ply -r @report.json"},
        {"check @other --poses @in --results @results.jsonl -r @report.json"},
        {"clash @in @other --html @page.html --png @p.png --png-size 400x300"},
    }};
    return all;
}
