#include "tools/picture/page.hpp"

#include "tools/picture/assets.hpp"
#include "tools/picture/pack.hpp"
#include <treeform/tf.hpp>

namespace tools {
namespace {

/// No "<" in it can end or nest a script element: JSON may write one as a number.
std::string as_script_data(const nlohmann::ordered_json& data) {
    std::string text = data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
        text.replace(at, 1, "\\u003c");
    return text;
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

std::string html(const scene& shown) {
    const packed_scene packed = pack(shown);
    std::string text =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "script-src 'unsafe-inline'; style-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
        escaped(shown.title) + "</title>\n<style>\n";
    text += viewer_css;
    text +=
        "</style>\n</head>\n<body>\n<h1>" + escaped(shown.title) + "</h1>\n<p class=\"verdict " +
        (shown.good ? "good" : "bad") + "\">" + escaped(shown.verdict) +
        "</p>\n<div class=\"view\" id=\"view\"></div>\n<div id=\"below\"></div>\n"
        "<noscript><p>The view and the tables need JavaScript.</p></noscript>\n"
        "<script type=\"application/json\" id=\"scene\">" +
        as_script_data(packed.header) + "</script>\n<script type=\"text/plain\" id=\"geometry\">" +
        packed.geometry + "</script>\n<script>\n";
    text += viewer_js;
    return text + "</script>\n</body>\n</html>\n";
}

}  // namespace tools
