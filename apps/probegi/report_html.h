#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace probegi::tool {

/// A picture of the report. All texts are plain; the writer escapes them.
struct ReportPicture {
    std::string id;       ///< unique within its scene, letters and digits
    std::string title;    ///< as in the sliders' lists
    std::string caption;  ///< one sentence
    std::string alt;      ///< for those who cannot see it
    std::string png;      ///< the file's bytes
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

struct ReportScene {
    std::string title;
    std::string summary;  ///< one sentence
    std::vector<ReportFigure> figures;
    std::vector<ReportPicture> pictures;  ///< none, leaky, ddgi, reference
    std::vector<ReportPicture> errorMaps;
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
/// it). Each scene gets two sliders: no GI against the field, and the field against the reference.
std::string reportHtml(const Report& report);

}  // namespace probegi::tool
