#include "pipeline/batch_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "formats/files.h"
#include "pipeline/content_hash.h"
#include "pipeline/outputs.h"
#include "pipeline/path_json.h"
#include "pipeline/version.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
using State = BatchPicture::State;
using nlohmann::ordered_json;

constexpr const char *kReport = "report.json", *kSheet = "index.html";

std::string_view state_name(State state) {
    switch (state) {
        case State::done: return "done";
        case State::up_to_date: return "up to date";
        case State::failed: return "failed";
        case State::not_reached: return "not reached";
    }
    return "";
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    return out;
}

/// A path as a relative URL: whatever could mean something else is written as %XX.
std::string url(const fs::path& path) {
    std::string out;
    for (const char c : path.generic_string()) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                           c == '.' || c == '-' || c == '_';
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out.find(':') == std::string::npos ? out : "./" + out;
}

constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>dstylize: contact sheet</title>
<style>
body { margin: 2rem; font: 15px/1.4 system-ui, sans-serif; color: #222; background: #f6f5f2; }
section { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 1.5rem; }
figure { margin: 0; padding: .75rem; background: #fff; border: 1px solid #ddd; }
figure div { display: grid; grid-template-columns: 1fr 1fr; gap: .5rem; }
img { width: 100%; height: 14rem; object-fit: contain; background: #eee; }
figcaption { margin-top: .5rem; overflow-wrap: anywhere; }
.failed { border-color: #b3261e; }
.failed b { color: #b3261e; }
</style>
)";

/// A thumbnail that leads to its picture, which stands in for it where it is missing.
std::string image(const std::string& picture, const fs::path& output, const fs::path& thumbnail,
                  const std::string& what) {
    std::error_code ignored;
    return fmt::format("<a href=\"{}\"><img loading=\"lazy\" alt=\"{}\" src=\"{}\"></a>", picture, escaped(what),
                       fs::exists(output / thumbnail, ignored) ? url(thumbnail) : picture);
}

/// The first result that a browser shows, if there is one.
const std::string& shown_result(const BatchPicture& picture) {
    for (const std::string& result : picture.results)
        if (!result.ends_with(".json")) return result;
    return picture.results.front();
}

std::string figure(const BatchPicture& picture, const fs::path& to_input, const fs::path& output) {
    const std::string original = url(to_input / picture.input);
    if (picture.state == State::failed)
        return fmt::format(
            "<figure class=\"failed\"><figcaption><a href=\"{}\">{}</a><br><b>{}</b>: {}</figcaption>"
            "</figure>\n",
            original, escaped(picture.input), escaped(picture.problem), escaped(picture.remedy));
    std::string caption = escaped(picture.input);
    if (picture.results.size() > 1)
        for (const std::string& result : picture.results)
            caption +=
                fmt::format(" <a href=\"{}\">{}</a>", url(result), escaped(fs::path(result).extension().string()));
    return "<figure><div>" + image(original, output, thumbnail_before(picture), picture.input + ", before") +
           image(url(shown_result(picture)), output, thumbnail_after(picture), picture.input + ", after") +
           fmt::format("</div><figcaption>{}</figcaption></figure>\n", caption);
}

ordered_json json_of(const BatchReport& report) {
    ordered_json tree;
    tree["program"] = fmt::format("dstylize {}", version());
    tree["style"] = report.style;
    for (const State state : {State::done, State::up_to_date, State::failed, State::not_reached})
        tree[std::string(state_name(state))] = report.count(state);
    tree["pictures"] = ordered_json::array();
    for (const BatchPicture& picture : report.pictures) {
        ordered_json row{{"input", path_json<ordered_json>(picture.input)},
                         {"results", ordered_json::array()},
                         {"state", state_name(picture.state)}};
        for (const std::string& result : picture.results) row["results"].push_back(path_json<ordered_json>(result));
        if (picture.state == State::failed) {
            row["problem"] = picture.problem;
            row["remedy"] = picture.remedy;
        }
        tree["pictures"].push_back(row);
    }
    return tree;
}

/// Messages may name files, and names need not be UTF-8.
std::string json_text(const ordered_json& tree) {
    return tree.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// Named after the results, whatever their formats; where that would be too long for a file's name, by its hash.
fs::path thumbnail(const BatchPicture& picture, std::string_view which) {
    constexpr std::size_t kLongest = 240;
    fs::path name = picture.results.front();
    name.replace_extension();
    const std::string last = name.filename().string();
    if (last.size() > kLongest) name.replace_filename(content_hash(std::as_bytes(std::span(last))));
    name += fmt::format(".{}.jpg", which);
    return fs::path(".dstylize/thumbnails") / name;
}

}  // namespace

fs::path thumbnail_before(const BatchPicture& picture) { return thumbnail(picture, "before"); }
fs::path thumbnail_after(const BatchPicture& picture) { return thumbnail(picture, "after"); }

std::string batch_report_json(const BatchReport& report) { return json_text(json_of(report)); }

std::string batch_report_json(std::span<const BatchReport> reports) {
    if (reports.size() == 1) return batch_report_json(reports[0]);
    ordered_json list = ordered_json::array();
    for (const BatchReport& report : reports) list.push_back(json_of(report));
    return json_text(list);
}

std::string contact_sheet_html(const BatchReport& report, const fs::path& input, const fs::path& output) {
    const fs::path to_input = fs::proximate(fs::absolute(input), fs::absolute(output));
    std::string out(kHead);
    const std::size_t not_reached = report.count(State::not_reached);
    out += fmt::format("<h1>{}</h1>\n<p>{} drawn, {} up to date, {} failed{}.</p>\n<section>\n", escaped(report.style),
                       report.count(State::done), report.count(State::up_to_date), report.count(State::failed),
                       not_reached > 0 ? fmt::format(", {} not reached", not_reached) : "");
    for (const bool failed : {true, false})
        for (const BatchPicture& picture : report.pictures)
            if (picture.state != State::not_reached && (picture.state == State::failed) == failed)
                out += figure(picture, to_input, output);
    return out + "</section>\n";
}

void check_batch_reports(const fs::path& output, bool force) {
    for (const char* const name : {kReport, kSheet}) {
        check_inside(output, output / name);
        check_target(output / name, {}, force);
    }
}

void write_batch_reports(const BatchReport& report, const fs::path& input, const fs::path& output) {
    const auto write = [&](const char* name, const std::string& text) {
        check_inside(output, output / name);
        write_file_atomically(output / name, std::as_bytes(std::span(text)));
    };
    write(kReport, batch_report_json(report));
    write(kSheet, contact_sheet_html(report, input, output));
}

}  // namespace dstylize
