#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace probegi::tool {

/// A picture of the report. All texts are plain; the writer escapes them.
struct ReportPicture {
    std::string id{};       ///< unique within its view, letters and digits
    std::string title{};    ///< as in the sliders' lists
    std::string caption{};  ///< one sentence
    std::string alt{};      ///< for those who cannot see it
    std::string png{};      ///< the file's bytes
    std::string values{};   ///< bytes of the PNG of halfFloatPlanes(): what a pixel says when pointed at; may be empty
    std::string unit{};     ///< of the values
    bool light = false;     ///< values are light: the exposure slider acts on it
    std::string exr{};      ///< name of the file beside the page; empty: none
};

struct ReportTable {
    std::string caption;
    std::vector<std::string> header;             ///< may be empty; the first column names the row
    std::vector<std::vector<std::string>> rows;  ///< as long as the header where there is one
    std::string note;                            ///< under the table; may be empty
};

/// A number worth a tile of its own.
struct ReportFigure {
    std::string value;
    std::string label;
};

/// What one camera sees.
struct ReportView {
    std::string title;                    ///< empty: the scene's only one
    float exposure = 1;                   ///< of its pictures
    bool filmic = false;                  ///< whether they were shown with the filmic curve
    std::vector<ReportPicture> pictures;  ///< none, leaky, ddgi, reference
    std::vector<ReportPicture> maps;      ///< where they differ from the reference
};

/// What the colour of something means.
struct ReportKey {
    std::string colour;  ///< CSS
    std::string label;
};

struct ReportScene {
    std::string title;
    std::string verdict;    ///< the sentence that comes first
    std::string judgement;  ///< in a word, as nameOf(Judgement): colours the verdict
    std::string summary;    ///< one sentence
    std::vector<ReportFigure> figures;
    std::vector<ReportView> views;
    std::vector<ReportPicture> probes;  ///< the first view with its probes; none or one
    std::vector<ReportKey> probeKey;
    std::vector<ReportTable> tables;
};

struct Report {
    std::string title;
    std::string commandLine;          ///< how to make it again
    std::vector<std::string> legend;  ///< CSS colours of the error maps, from 0 to 1
    std::vector<ReportScene> scenes;
};

/// Text as HTML: usable between tags and inside quoted attributes.
std::string escapeHtml(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// One self-contained page: pictures, style and script inside, no request to anywhere (a policy in the page forbids
/// it). Each view gets two sliders, no GI against the field and the field against the reference, and a slider for its
/// exposure; a click on a picture shows it pixel by pixel, with the values behind it.
std::string reportHtml(const Report& report);

}  // namespace probegi::tool
