#include "tools/picture/font.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace tools {
namespace {

/// A letter is paths with spaces between them; a path is points of two hexadecimal digits, x and y.
/// Lines stand at y = 3, small letters reach 9 and capitals 12. Of a path after "~", the points
/// pull at a curve, which is closed where they are.
constexpr std::array<const char*, 95> glyphs{
    "",                                      // space
    "0c06 0304",                             // !
    "0c0a 2c2a",                             // "
    "2c13 5c43 0a6a 0565",                   // #
    "~6a6c0c0868630305 3d32",                // $
    "~080c3c3808 035c ~3363673733",          // %
    "~631a1c4c4a06034367",                   // &
    "0c0a",                                  // '
    "~2d0b0422",                             // (
    "~0d2b2402",                             // )
    "2c26 0b47 074b",                        // *
    "0767 3a34",                             // +
    "1401",                                  // ,
    "0747",                                  // -
    "0304",                                  // .
    "025d",                                  // /
    "~03535c0c03",                           // 0
    "0a2c23",                                // 1
    "~0a0c5c5803 0353",                      // 2
    "~0b0c5c5828 ~2858530304",               // 3
    "434c0565",                              // 4
    "5c0c08 ~0859530304",                    // 5
    "~5b5c0c0353580805",                     // 6
    "0c5c13",                                // 7
    "~08585c0c08 ~0353580803",               // 8
    "~0403535c0c07575a",                     // 9
    "0304 0809",                             // :
    "1401 1819",                             // ;
    "5a0754",                                // <
    "0555 0959",                             // =
    "0a5704",                                // >
    "~0a0c5c582826 2324",                    // ?
    "~2555582825 ~5855757c0c0373",           // @
    "033c63 1555",                           // A
    "030c3c ~3c6c6838 3808 ~38686333 3303",  // B
    "~6a6c0c036365",                         // C
    "030c2c ~2c6c6323 2303",                 // D
    "5c0c0353 0848",                         // E
    "5c0c03 0848",                           // F
    "~6a6c0c036367 6737",                    // G
    "030c 636c 0868",                        // H
    "030c",                                  // I
    "~5c530305",                             // J
    "030c 066c 2863",                        // K
    "0c0353",                                // L
    "030c468c83",                            // M
    "030c636c",                              // N
    "~03737c0c03",                           // O
    "030c3c ~3c6c6737 3707",                 // P
    "~03737c0c03 4572",                      // Q
    "030c3c ~3c6c6737 3707 3763",            // R
    "~6a6c0c0868630305",                     // S
    "0c6c 3c33",                             // T
    "~0c03636c",                             // U
    "0c336c",                                // V
    "0c234c638c",                            // W
    "0c63 036c",                             // X
    "0c376c 3733",                           // Y
    "0c6c0363",                              // Z
    "2d0d0222",                              // [
    "0d52",                                  // backslash
    "0d2d2202",                              // ]
    "092c49",                                // ^
    "0262",                                  // _
    "0c1a",                                  // `
    "~0353590903 5953",                      // a
    "0c03 ~0353590903",                      // b
    "~585909035354",                         // c
    "5c53 ~0353590903",                      // d
    "0656 ~565909035354",                    // e
    "~4c1c1a13 0939",                        // f
    "~0353590903 ~5952502001",               // g
    "030c ~06095953",                        // h
    "0309 0b0c",                             // i
    "~29222000 2b2c",                        // j
    "0c03 0559 2753",                        // k
    "0c05 ~050323",                          // l
    "0309 ~06094943 ~46498983",              // m
    "0309 ~06095953",                        // n
    "~0353590903",                           // o
    "0900 ~0353590903",                      // p
    "5950 ~0353590903",                      // q
    "0309 ~060949",                          // r
    "~5859090656530304",                     // s
    "~1b151343 0939",                        // t
    "~09035356 5953",                        // u
    "093369",                                // v
    "0923496389",                            // w
    "0953 0359",                             // x
    "0933 6910",                             // y
    "09590353",                              // z
    "~2d1d1807 ~07161222",                   // {
    "0d02",                                  // |
    "~0d1d1827 ~27161202",                   // }
    "~07194658",                             // ~
};
constexpr const char* unknown = "03434c0c03";
constexpr double cap_height = 9.0;  // in steps of letters
constexpr double base_line = 3.0;
constexpr double gap = 2.4;
constexpr double space = 3.0;
constexpr double line_width = 1.25;

const char* glyph_of(unsigned char c) { return c >= 32 && c < 127 ? glyphs[c - 32U] : unknown; }

double step_of(char c) { return c >= 'a' ? c - 'a' + 10 : c - '0'; }

double width_of(const char* glyph) {
    double widest = *glyph == 0 ? space : 0.0;
    for (bool is_x = true; *glyph != 0; ++glyph) {
        if (*glyph == '~' || *glyph == ' ') continue;
        if (is_x) widest = std::max(widest, step_of(*glyph));
        is_x = !is_x;
    }
    return widest;
}

using path = std::vector<pixel_position>;

/// One round of cutting corners (Chaikin): its limit is the quadratic B-spline of the points.
path rounder(const path& p, bool closed) {
    path result;
    if (!closed) result.push_back(p.front());
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        const pixel_position &a = p[i], &b = p[i + 1];
        if (closed || i > 0) result.push_back({0.75 * a.x + 0.25 * b.x, 0.75 * a.y + 0.25 * b.y});
        if (closed || i + 2 < p.size())
            result.push_back({0.25 * a.x + 0.75 * b.x, 0.25 * a.y + 0.75 * b.y});
    }
    result.push_back(closed ? result.front() : p.back());
    return result;
}

void add_path(std::vector<std::array<pixel_position, 2>>& to, path points, bool curved) {
    if (points.empty()) return;
    const pixel_position &first = points.front(), &last = points.back();
    const bool closed = curved && first.x == last.x && first.y == last.y;
    for (int round = 0; round < 3 && curved; ++round) points = rounder(points, closed);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) to.push_back({points[i], points[i + 1]});
}

std::vector<std::array<pixel_position, 2>> segments_of(const char* glyph) {
    std::vector<std::array<pixel_position, 2>> segments;
    path points;
    bool curved = false;
    for (; *glyph != 0; ++glyph) {
        if (*glyph == ' ') {
            add_path(segments, std::exchange(points, {}), curved);
            curved = false;
        } else if (*glyph == '~') {
            curved = true;
        } else {
            points.push_back({step_of(glyph[0]), step_of(glyph[1]) - base_line});
            ++glyph;
        }
    }
    add_path(segments, std::move(points), curved);
    return segments;
}

bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

void write(picture& on, pixel_position at, std::string_view text, double size, double width,
           const rgb& color, unsigned share) {
    const double step = size / cap_height;
    for (const char c : text) {
        if (continues_letter(c)) continue;
        const char* const glyph = glyph_of(static_cast<unsigned char>(c));
        auto segments = segments_of(glyph);
        for (auto& s : segments)
            for (pixel_position& p : s) p = {at.x + step * p.x, at.y - step * p.y};
        stroke(on, segments, width, color, share);
        at.x += step * (width_of(glyph) + gap);
    }
}

}  // namespace

double text_width(std::string_view text, double size) {
    double width = 0.0;
    for (const char c : text)
        if (!continues_letter(c)) width += width_of(glyph_of(static_cast<unsigned char>(c))) + gap;
    return std::max(0.0, width - gap) * size / cap_height;
}

void draw_text(picture& on, pixel_position at, std::string_view text, double size,
               const rgb& color) {
    write(on, at, text, size, std::max(1.0, line_width * size / cap_height), color, 256);
}

void draw_label(picture& on, pixel_position at, std::string_view text, double size,
                const rgb& color) {
    write(on, at, text, size, std::max(3.0, 0.4 * size), paper, 200);
    draw_text(on, at, text, size, color);
}

std::string shortened(const std::string& text, double size, double room) {
    if (text_width(text, size) <= room) return text;
    std::string start = text;
    while (!start.empty() && text_width(start + "...", size) > room) {
        while (start.size() > 1 && continues_letter(start.back())) start.pop_back();
        start.pop_back();
    }
    return start.empty() ? start : start + "...";
}

}  // namespace tools
