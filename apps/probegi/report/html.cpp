#include "report/html.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "report/assets.h"

namespace probegi::tool {

namespace {

/// A view's place on the page, which its pictures' ids are made from.
struct Place {
    std::size_t scene, view;
    std::string id(std::string_view picture) const { return fmt::format("s{}v{}-{}", scene, view, picture); }
};

std::string dataUri(const std::string& png) {
    return "data:image/png;base64," + base64(png);
}

std::string image(const ReportPicture& picture, const std::string& id) {
    std::string html = fmt::format("<img id=\"{}\" alt=\"{}\" src=\"{}\"", escapeHtml(id), escapeHtml(picture.alt),
                                   dataUri(picture.png));
    if (!picture.values.empty())
        html += fmt::format(" data-values=\"{}\" data-unit=\"{}\"", dataUri(picture.values), escapeHtml(picture.unit));
    if (picture.light) html += " data-light";
    return html + ">";
}

std::string figure(const ReportPicture& picture, const std::string& id) {
    std::string html = fmt::format(
        "<figure><button class=\"zoom\" aria-label=\"Full size: {}\">{}</button><figcaption><strong>{}.</strong> {}",
        escapeHtml(picture.title), image(picture, id), escapeHtml(picture.title), escapeHtml(picture.caption));
    if (!picture.exr.empty())
        html += fmt::format(" <a href=\"{}\" download>{}</a>", escapeHtml(picture.exr), escapeHtml(picture.exr));
    return html + "</figcaption></figure>\n";
}

std::string options(const ReportView& view, const Place& place, std::size_t chosen) {
    std::string html;
    std::size_t index = 0;
    for (const auto* list : {&view.pictures, &view.maps})
        for (const ReportPicture& picture : *list)
            html += fmt::format("<option value=\"{}\"{}>{}</option>", escapeHtml(place.id(picture.id)),
                                index++ == chosen ? " selected" : "", escapeHtml(picture.title));
    return html;
}

/// The script shows the gallery's pictures in it, so that the file contains each only once.
std::string slider(const ReportView& view, const Place& place, std::size_t left, std::size_t right) {
    return fmt::format(
        "<div class=\"slider\"><div class=\"stage\"><img class=\"left\" alt=\"\"><img class=\"right\" alt=\"\">"
        "<span class=\"tag a\"></span><span class=\"tag b\"></span><span class=\"bar\"></span>"
        "<input type=\"range\" min=\"0\" max=\"100\" step=\"any\" value=\"50\" "
        "aria-label=\"Where the left picture ends, in percent\"></div>\n"
        "<div class=\"choose\"><label>Left <select>{}</select></label><label>Right <select>{}</select></label></div>"
        "</div>\n",
        options(view, place, left), options(view, place, right));
}

std::string exposureSlider() {
    return "<div class=\"exposure\"><label>Exposure <input type=\"range\" min=\"-8\" max=\"8\" step=\"0.1\" "
           "value=\"0\"></label> <output></output> <button>as made</button></div>\n";
}

std::string gallery(const std::vector<ReportPicture>& pictures, const Place& place, const char* kind) {
    std::string html = fmt::format("<div class=\"gallery{}\">", kind);
    for (const ReportPicture& picture : pictures) html += figure(picture, place.id(picture.id));
    return html + "</div>\n";
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

std::string viewSection(const Report& report, const ReportView& view, const Place& place) {
    std::string html =
        fmt::format("<div class=\"view\" data-exposure=\"{}\" data-filmic=\"{}\">\n", view.exposure, int(view.filmic));
    if (!view.title.empty()) html += fmt::format("<h3>{}</h3>\n", escapeHtml(view.title));
    if (view.pictures.size() >= 2) {
        const std::size_t reference = view.pictures.size() - 1;
        const std::size_t field = reference - 1;
        html += exposureSlider() + "<div class=\"pair\">" + slider(view, place, 0, field) +
                slider(view, place, field, reference) +
                "</div>\n<noscript><p>The sliders need JavaScript; the pictures below do not.</p></noscript>\n";
    }
    html += "<h4>Side by side</h4>" + gallery(view.pictures, place, "");
    if (!view.maps.empty())
        html += "<h4>Where the difference from the reference can be seen</h4>\n" + legend(report.legend) +
                gallery(view.maps, place, " maps");
    return html + "</div>\n";
}

std::string probeSection(const ReportScene& scene, std::size_t number) {
    if (scene.probes.empty()) return {};
    std::string html = "<h3>The probes</h3>\n<ul class=\"key\">";
    for (const ReportKey& key : scene.probeKey)
        html += fmt::format("<li><span style=\"background: {}\"></span>{}</li>", escapeHtml(key.colour),
                            escapeHtml(key.label));
    return html + "</ul>\n" + gallery(scene.probes, {number, 0}, "");
}

std::string section(const Report& report, std::size_t number) {
    const ReportScene& scene = report.scenes[number];
    std::string html = fmt::format(
        "<section id=\"scene{}\"><h2>{}</h2><p class=\"verdict {}\">{}</p><p class=\"quiet\">{}</p>\n", number,
        escapeHtml(scene.title), escapeHtml(scene.judgement), escapeHtml(scene.verdict), escapeHtml(scene.summary));
    html += tiles(scene.figures);
    for (std::size_t view = 0; view < scene.views.size(); ++view)
        html += viewSection(report, scene.views[view], {number, view});
    html += probeSection(scene, number) + "<div class=\"tables\">";
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
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
)html";

constexpr std::string_view kPixelDialog = R"html(<dialog id="pixels" aria-label="Picture in full size">
<div class="tools"><strong></strong><span><button data-zoom="1">1:1</button> <button data-zoom="2">2:1</button>
<button data-zoom="4">4:1</button> <button data-close>Close</button></span></div>
<output>Point at the picture: its values come here.</output><div class="scroll"><canvas></canvas></div></dialog>
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
        "line, or use the arrow keys; click a picture to see it pixel by pixel, with its "
        "values.</p>{}</header>\n<main>\n",
        escapeHtml(report.title), navigation(report));
    for (std::size_t i = 0; i < report.scenes.size(); ++i) html += section(report, i);
    html += fmt::format("</main>\n<footer><div><p>{}</p><p>Made by <code>{}</code></p></div></footer>\n", kGlossary,
                        escapeHtml(report.commandLine));
    html += kPixelDialog;
    html += fmt::format("<script>{}</script>\n</body></html>\n", kReportScript);
    return html;
}

}  // namespace probegi::tool
