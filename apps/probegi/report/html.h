#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace probegi::tool {

/// A picture of the report. All texts are plain; reportHtml() escapes them.
struct ReportPicture {
    std::string id{};       ///< unique within its view, letters and digits
    std::string title{};    ///< also in the sliders' lists
    std::string caption{};  ///< one sentence
    std::string alt{};      ///< for screen readers
    std::string png{};      ///< the file's bytes
    std::string values{};   ///< PNG of halfFloatPlanes(): values shown when pointing at a pixel; may be empty
    std::string unit{};     ///< of the values
    bool light = false;     ///< the exposure slider applies
    std::string exr{};      ///< name of the file beside the page; empty: none
};

struct ReportTable {
    std::string caption;
    std::vector<std::string> header;             ///< may be empty; the first column names the row
    std::vector<std::vector<std::string>> rows;  ///< as long as the header, if there is one
    std::string note;                            ///< under the table; may be empty
};

/// A number shown large, in a tile.
struct ReportFigure {
    std::string value;
    std::string label;
};

/// The pictures of one camera.
struct ReportView {
    std::string title;                    ///< empty if it is the scene's only one
    float exposure = 1;                   ///< of its pictures
    bool filmic = false;                  ///< whether they use the filmic curve
    std::vector<ReportPicture> pictures;  ///< none, leaky, ddgi, reference
    std::vector<ReportPicture> maps;      ///< of their differences from the reference
};

/// An entry of the key of colours.
struct ReportKey {
    std::string colour;  ///< CSS
    std::string label;
};

struct ReportScene {
    std::string title;
    std::string verdict;    ///< one sentence, at the top
    std::string judgement;  ///< nameOf(Judgement), which sets the verdict's colour
    std::string summary;    ///< one sentence
    std::vector<ReportFigure> figures;
    std::vector<ReportView> views;
    std::vector<ReportPicture> probes;  ///< the first view with its probes drawn; at most one
    std::vector<ReportKey> probeKey;
    std::vector<ReportTable> tables;
};

struct Report {
    std::string title;
    std::string commandLine;          ///< reproduces the report
    std::vector<std::string> legend;  ///< CSS colours of the error maps, from 0 to 1
    std::vector<ReportScene> scenes;
};

/// Escapes text for use between tags and inside quoted attributes.
std::string escapeHtml(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// One self-contained page: pictures, style and script are embedded, and a policy in the page forbids all requests.
/// Each view gets two sliders, no GI against the field and the field against the reference, and a slider for the
/// exposure. A click on a picture shows it pixel by pixel, with the values behind it.
std::string reportHtml(const Report& report);

}  // namespace probegi::tool
