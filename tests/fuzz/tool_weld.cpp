#include "tool.hpp"
#include <treeform/tf.hpp>

#include <array>

std::span<const tf::fuzz::tool_command> tf::fuzz::tool_commands() {
    static constexpr std::array<tool_command, 8> all{{
        {"@in -o @out.obj --html @page.html --png @p.png --png-size 64x48"},
        {"@in -t 0.01% -o @out.ply --removed @removed.csv --map @map.csv -r @report.json"},
        {"@in -t 1% --rule chain --keep mean -o @out.ply --html @page.html"},
        {"@in -t 0.1 --label group -o @out.ply --map @map.bin"},
        {"@in -t 0.1% --borders --keep-manifold -o @out.off"},
        {"@in @other --join -t 0.01 --keep last -o @out.stl -r @report.json"},
        {"@in -t 0.1% --tile-points 64 --work @tiles -o @out.ply --map @map.bin"},
        {"@in -t 0 --ignore-seams normal,uv -o @out.glb --precision float"},
    }};
    return all;
}
