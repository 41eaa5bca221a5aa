#include "report_html.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "report_assets.h"

namespace probegi::tool {

namespace {

std::string elementId(std::size_t scene, std::string_view picture) {
    return fmt::format("s{}-{}", scene, picture);
}

std::string image(const ReportPicture& picture, const std::string& id) {
    return fmt::format("<img id=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">", escapeHtml(id),
                       escapeHtml(picture.alt), base64(picture.png));
}

std::string figure(const ReportPicture& picture, const std::string& id) {
    return fmt::format("<figure>{}<figcaption><strong>{}.</strong> {}</figcaption></figure>\n", image(picture, id),
                       escapeHtml(picture.title), escapeHtml(picture.caption));
}

std::string options(const ReportScene& scene, std::size_t number, std::size_t chosen) {
    std::string html;
    std::size_t index = 0;
    for (const auto* list : {&scene.pictures, &scene.errorMaps})
        for (const ReportPicture& picture : *list)
            html += fmt::format("<option value=\"{}\"{}>{}</option>", escapeHtml(elementId(number, picture.id)),
                                index++ == chosen ? " selected" : "", escapeHtml(picture.title));
    return html;
}

/// Its pictures are those of the gallery below: the script points at them, so that each is in the file only once.
std::string slider(const ReportScene& scene, std::size_t number, std::size_t left, std::size_t right) {
    return fmt::format(
        "<div class=\"slider\"><div class=\"stage\"><img class=\"left\" alt=\"\"><img class=\"right\" alt=\"\">"
        "<span class=\"tag a\"></span><span class=\"tag b\"></span><span class=\"bar\"></span>"
        "<input type=\"range\" min=\"0\" max=\"100\" step=\"any\" value=\"50\" "
        "aria-label=\"Where the left picture ends, in percent\"></div>\n"
        "<div class=\"choose\"><label>Left <select>{}</select></label><label>Right <select>{}</select></label></div>"
        "</div>\n",
        options(scene, number, left), options(scene, number, right));
}

std::string tiles(const std::vector<ReportFigure>& figures) {
    if (figures.empty()) return {};
    std::string html = "<dl class=\"tiles\">";
    for (const ReportFigure& figure : figures)
        html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escapeHtml(figure.label), escapeHtml(figure.value));
    return html + "</dl>\n";
}

std::string table(const ReportTable& table) {
    std::string html = fmt::format("<div class=\"sheet\"><table><caption>{}</caption>", escapeHtml(table.caption));
    if (!table.header.empty()) {
        html += "<thead><tr>";
        for (const std::string& cell : table.header) html += fmt::format("<th scope=\"col\">{}</th>", escapeHtml(cell));
        html += "</tr></thead>";
    }
    html += "<tbody>";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", escapeHtml(row[i]))
                           : fmt::format("<td>{}</td>", escapeHtml(row[i]));
        html += "</tr>";
    }
    html += "</tbody></table>";
    if (!table.note.empty()) html += fmt::format("<p>{}</p>", escapeHtml(table.note));
    return html + "</div>\n";
}

std::string legend(const std::vector<std::string>& colours) {
    std::string stops;
    for (const std::string& colour : colours) stops += (stops.empty() ? "" : ", ") + colour;
    return fmt::format(
        "<div class=\"legend\" role=\"img\" aria-label=\"Colours of the error maps: dark is no difference, bright is "
        "the largest\"><span>0 same</span><span class=\"ramp\" style=\"background: linear-gradient(to right, {})\">"
        "</span><span>1 worst</span></div>\n",
        escapeHtml(stops));
}

std::string section(const Report& report, std::size_t number) {
    const ReportScene& scene = report.scenes[number];
    std::string html = fmt::format("<section id=\"scene{}\"><h2>{}</h2><p class=\"quiet\">{}</p>\n", number,
                                   escapeHtml(scene.title), escapeHtml(scene.summary));
    html += tiles(scene.figures);
    if (scene.pictures.size() >= 2) {
        const std::size_t reference = scene.pictures.size() - 1;
        const std::size_t field = reference - 1;
        html += "<div class=\"pair\">" + slider(scene, number, 0, field) + slider(scene, number, field, reference) +
                "</div>\n<noscript><p>The sliders need JavaScript; the pictures below do not.</p></noscript>\n";
    }
    html += "<h3>Side by side</h3><div class=\"gallery\">";
    for (const ReportPicture& picture : scene.pictures) html += figure(picture, elementId(number, picture.id));
    html += "</div>\n";
    if (!scene.errorMaps.empty()) {
        html += "<h3>Where the difference from the reference can be seen</h3>\n" + legend(report.legend) +
                "<div class=\"gallery maps\">";
        for (const ReportPicture& picture : scene.errorMaps) html += figure(picture, elementId(number, picture.id));
        html += "</div>\n";
    }
    html += "<div class=\"tables\">";
    for (const ReportTable& entry : scene.tables) html += table(entry);
    return html + "</div></section>\n";
}

std::string navigation(const Report& report) {
    if (report.scenes.size() < 2) return {};
    std::string html = "<nav aria-label=\"Scenes\"><ul>";
    for (std::size_t i = 0; i < report.scenes.size(); ++i)
        html += fmt::format("<li><a href=\"#scene{}\">{}</a></li>", i, escapeHtml(report.scenes[i].title));
    return html + "</ul></nav>";
}

constexpr std::string_view kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
)html";

constexpr std::string_view kGlossary =
    "Errors are distances from the reference. RMSE: root mean square over display values from 0 to 1. relMSE: mean of "
    "the squared difference over the squared reference (plus 0.01), on linear light. FLIP: how visible the difference "
    "is to someone who flips between the two pictures, 0 to 1, at 67 pixels per degree of sight.";

}  // namespace

std::string escapeHtml(std::string_view text) {
    std::string html;
    html.reserve(text.size());
    for (const char c : text) switch (c) {
            case '&':
                html += "&amp;";
                break;
            case '<':
                html += "&lt;";
                break;
            case '>':
                html += "&gt;";
                break;
            case '"':
                html += "&quot;";
                break;
            case '\'':
                html += "&#39;";
                break;
            default:
                html += c;
        }
    return html;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? std::uint32_t(std::uint8_t(bytes[i + k])) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string reportHtml(const Report& report) {
    std::string html(kHead);
    html +=
        fmt::format("<title>{}</title>\n<style>{}</style></head>\n<body>\n", escapeHtml(report.title), kReportStyle);
    html += fmt::format(
        "<header><h1>{}</h1><p class=\"quiet\">Light from a field of probes, beside the path-traced truth. Drag the "
        "line, or use the arrow keys.</p>{}</header>\n<main>\n",
        escapeHtml(report.title), navigation(report));
    for (std::size_t i = 0; i < report.scenes.size(); ++i) html += section(report, i);
    html += fmt::format("</main>\n<footer><div><p>{}</p><p>Made by <code>{}</code></p></div></footer>\n", kGlossary,
                        escapeHtml(report.commandLine));
    html += fmt::format("<script>{}</script>\n</body></html>\n", kReportScript);
    return html;
}

}  // namespace probegi::tool
