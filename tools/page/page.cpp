#include "tools/page/page.hpp"

#include "tools/common/console.hpp"
#include "tools/page/assets.hpp"
#include <treeform/tf.hpp>

#include <nlohmann/json.hpp>

namespace tools {
namespace {

using json = nlohmann::ordered_json;

std::string coordinates(const tf::point3& p) {
    return shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z);
}

/// An element with `text`, escaped, in it.
std::string element(std::string_view open, std::string_view text, std::string_view close) {
    std::string out(open);
    out += escaped(text);
    out += close;
    return out;
}

/// A script element ends at the first "</": JSON may write the slash with a backslash.
std::string as_script_data(const json& data) {
    std::string text = data.dump(-1, ' ', true, json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
        text.insert(at + 1, 1, '\\');
    return text;
}

json scene_data(const page& contents) {
    constexpr std::size_t colors_in_shader = 16;
    const packed_scene& scene = contents.scene;
    json data{{"points", scene.points},     {"faces", scene.faces},
              {"segments", scene.segments}, {"low", {scene.low.x, scene.low.y, scene.low.z}},
              {"size", scene.size},         {"steps", scene.steps},
              {"step", scene.step}};
    data["kinds"] = json::array();
    data["colors"] = json::array();
    for (const face_kind& kind : contents.kinds) {
        data["kinds"].push_back(kind.name);
        data["colors"].push_back(kind.color);
    }
    while (data["colors"].size() < colors_in_shader) data["colors"].push_back("#000000");
    return data;
}

std::string legend(const page& contents) {
    std::string text = "<div class=\"bar\">\n";
    for (std::size_t k = 0; k < contents.kinds.size(); ++k) {
        const face_kind& kind = contents.kinds[k];
        if (k > 0 && kind.count == 0) continue;
        text +=
            "<label><input type=\"checkbox\" checked data-kind=\"" + std::to_string(k) +
            "\"><span class=\"swatch\" style=\"background:" + kind.color + "\"></span>" +
            escaped(kind.name) + " (" +
            (k == 0 ? counted(kind.count, "face", "faces") : counted(kind.count, "pair", "pairs")) +
            ")</label>\n";
    }
    text +=
        "<label><input type=\"checkbox\" checked data-curves> curves</label>\n"
        "<label><input type=\"checkbox\" data-glass> see through</label>\n";
    text += contents.y_is_up ? "<label><input type=\"checkbox\" checked"
                             : "<label><input type=\"checkbox\"";
    text += " data-up> y is up</label>\n";
    if (!contents.places.empty()) text += "<button data-next>next region</button>";
    return text + "<button data-home>whole model</button>\n</div>\n";
}

/// What the view leaves out.
std::string left_out(const packed_scene& scene) {
    std::string text;
    const auto name = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
    };
    name(scene.plain_left_out, "other face", "other faces");
    name(scene.marked_left_out, "face of a pair", "faces of pairs");
    name(scene.segments_left_out, "curve segment", "curve segments");
    return text.empty() ? text : " Not drawn, to keep the page light: " + text + ".";
}

std::string view(const page& contents) {
    std::string text = "<div class=\"view\" id=\"view\">\n<canvas></canvas>\n" + legend(contents) +
                       "<div class=\"picked\"></div>\n</div>\n"
                       "<p class=\"note\">Drag to turn, right button or Shift to shift, wheel to "
                       "zoom, click for the number of a face.";
    return text + left_out(contents.scene) + "</p>\n";
}

std::string places(const page& contents) {
    if (contents.places.empty()) return {};
    std::string text = "<h2>Regions</h2>\n<div class=\"wide\"><table>\n<tr>";
    for (const auto& column : contents.place_columns) text += element("<th>", column, "</th>");
    text += "</tr>\n";
    for (const place_row& row : contents.places) {
        text += "<tr data-low=\"" + coordinates(row.low) + "\" data-high=\"" +
                coordinates(row.high) + "\">";
        for (const table_cell& cell : row.cells)
            text += element(cell.number ? "<td class=\"number\">" : "<td>", cell.text, "</td>");
        text += "</tr>\n";
    }
    text += "</table></div>\n<p class=\"note\">Click a row to fly to it.";
    if (!contents.places_note.empty()) text += " " + escaped(contents.places_note);
    return text + "</p>\n";
}

std::string facts(const page& contents) {
    std::string text = "<h2>What was looked at, and how</h2>\n<table>\n";
    for (const auto& [name, value] : contents.facts)
        text += element("<tr><td>", name, "</td>") +
                element("<td class=\"text\">", value, "</td></tr>\n");
    return text + "</table>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string html(const page& contents) {
    std::string text =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
        escaped(contents.title) + "</title>\n<style>\n";
    text += page_css;
    text += "</style>\n</head>\n<body>\n<h1>" + escaped(contents.title) +
            "</h1>\n<p class=\"verdict " + (contents.good ? "good" : "bad") + "\">" +
            escaped(contents.verdict) + "</p>\n";
    text += view(contents) + places(contents) + facts(contents);
    text += "<script type=\"application/json\" id=\"scene\">" +
            as_script_data(scene_data(contents)) +
            "</script>\n<script type=\"text/plain\" id=\"geometry\">" + contents.scene.geometry +
            "</script>\n<script>\n";
    text += viewer_js;
    return text + "</script>\n</body>\n</html>\n";
}

}  // namespace tools
