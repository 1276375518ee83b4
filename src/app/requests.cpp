// What the arguments of the command line ask for, as requests of the library.
#include "app/requests.h"

#include <algorithm>

#include "app/commands.h"
#include "pipeline/control_text.h"

namespace dstylize::app {

void set_output_options(RunRequest& request, const Arguments& a) {
    for (const std::string& output : a.outputs) request.outputs.emplace_back(output);
    if (a.formats.size() > 1)
        throw usage_error("--format " + a.formats[1], "is one format too many for one picture",
                          "give one; name further outputs with -o");
    if (!a.formats.empty()) request.format = a.formats[0];
    if (!a.size.empty()) request.size = parsed_output_size(a.size);
    if (a.scale > 0) request.size = {OutputSize::Kind::scale, a.scale, OutputSize::kDefaultDpi, {}, 0, 0};
    request.quality = a.quality;
    request.compression = a.compression;
    request.keep_recipe = !a.no_recipe;
    request.recipe_file = a.recipe_file;
    request.force = a.force;
    request.dry_run = a.dry_run;
    request.max_memory_bytes = a.max_memory;
}

void check_standard_output(const RunRequest& request, const Arguments& a) {
    const auto writers = std::count(request.outputs.begin(), request.outputs.end(), "-") + (a.recipe_file == "-") +
                         (a.json || a.dry_run);
    if (writers > 1)
        throw usage_error("", "more than one thing would be written to standard output", "write all but one to files");
}

namespace {

/// What `draw` and `write` share.
RunRequest picture_request(const Arguments& a) {
    RunRequest request;
    set_output_options(request, a);
    if (!a.styles.empty()) request.style = a.styles[0];
    request.user_styles = user_style_folder();
    for (const std::string& setting : a.settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos || equals == 0)
            throw usage_error("--set " + setting, "not a parameter and its value", "write section.key=value");
        request.settings.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
    }
    if (!a.blend.empty()) request.settings.push_back({"scene.blend", a.blend});
    request.detail = a.detail;
    request.seed = std::uint64_t(a.seed);
    request.no_picture = a.importance == "none";
    if (!request.no_picture) request.importance.path = a.importance;
    request.importance_replaces = a.importance_mode == "replace";
    if (!a.importance_mode.empty() && request.importance.path.empty())
        throw usage_error("--importance-mode", "there is no map for it", "give --importance FILE");
    request.mask.path = a.mask;
    request.endpoints.path = a.endpoints;
    for (const std::string& root : a.roots) request.roots.push_back(parsed_root(root));
    if (!a.background.empty()) request.background = parsed_background(a.background);
    request.show = a.show;
    return request;
}

/// In `write` two numbers are where the words' middle lies, four a box in the background.
bool is_box(const std::string& place) { return std::count(place.begin(), place.end(), ',') > 1; }

/// Shells pass \\n as two characters.
std::string with_line_breaks(std::string text) {
    for (std::size_t at; (at = text.find("\\n")) != std::string::npos;) text.replace(at, 2, "\n");
    return text;
}

Writing writing(const Arguments& a) {
    Writing out;
    out.lettering.text = with_line_breaks(a.names[0]);
    if (!a.font.empty()) out.lettering.font = a.font;
    if (!a.align.empty())
        out.lettering.align = a.align == "left"    ? Lettering::Align::left
                              : a.align == "right" ? Lettering::Align::right
                                                   : Lettering::Align::centre;
    out.lettering.letter_spacing = a.letter_spacing;
    out.lettering.line_spacing = a.line_spacing;
    out.size = a.text_size;
    if (a.place.empty() || is_box(a.place)) return out;
    const RootChoice place = parsed_root(a.place);
    if (place.place)
        throw usage_error("--place " + a.place, "is not a point",
                          "write x,y: fractions with a decimal point, or pixels");
    out.x = place.x;
    out.y = place.y;
    return out;
}

}  // namespace

RunRequest draw_request(const Arguments& a) {
    if (a.names.empty()) throw usage_error("", "no picture is named", "write dstylize IN OUT, or see dstylize --help");
    if (a.names.size() > 2)
        throw usage_error(a.names[2], "is one name too many", "write dstylize IN OUT; further outputs with -o");
    RunRequest request = picture_request(a);
    request.input = a.names[0];
    if (!a.place.empty()) request.place = parsed_place(a.place);
    if (a.names.size() > 1) request.outputs.insert(request.outputs.begin(), a.names[1]);
    return request;
}

RunRequest write_request(const Arguments& a) {
    const std::size_t words = a.mask.empty() ? 1 : 0, most = words + 2;
    const std::string form = words ? "write dstylize write TEXT [IN] OUT" : "write dstylize write --mask FILE [IN] OUT";
    if (a.names.size() < words) throw usage_error("write", "no words are given", form);
    if (a.names.size() > most) throw usage_error(a.names[most], "is one name too many", form);
    // The last name is the output unless there are others.
    const std::size_t files = a.names.size() - words;
    if (files + a.outputs.size() == 0) throw usage_error("write", "no output is named", form);
    RunRequest request = picture_request(a);
    if (words) request.writing = writing(a);
    if (is_box(a.place) || (!a.place.empty() && !words)) request.place = parsed_place(a.place);
    if (files > 0) request.outputs.insert(request.outputs.begin(), a.names.back());
    if (files > 1) request.input = a.names[words];
    const bool on_picture = files > 1;
    if (a.styles.empty()) request.style = on_picture ? "lichen-letters" : "letters";
    if (a.background.empty() && on_picture) request.background.kind = Background::Kind::input;
    return request;
}

CodecOptions codec_options(const Arguments& a) {
    CodecOptions options;
    options.max_memory_bytes = a.max_memory;
    options.allow_damaged = a.allow_damaged;
    return options;
}

namespace {

BatchRequest folder_request(const Arguments& a) {
    Arguments of_each = a;
    of_each.formats.clear();
    BatchRequest batch;
    batch.each = draw_request(of_each);
    batch.input = batch.each.input;
    if (a.names.size() > 1) {
        batch.output = a.names[1];
        batch.each.outputs.erase(batch.each.outputs.begin());
    }
    batch.patterns = a.patterns;
    batch.formats = a.formats;
    batch.name = a.name;
    batch.manifest = a.manifest;
    if (!a.shard.empty()) {
        batch.shard = parsed_shard(a.shard);
        if (a.manifest.empty())
            throw usage_error("--shard " + a.shard, "all shards need one list of the pictures", "give --manifest FILE");
    }
    batch.codec = codec_options(a);
    return batch;
}

}  // namespace

std::vector<BatchRequest> folder_requests(const Arguments& a) {
    BatchRequest batch = folder_request(a);
    if (a.styles.size() < 2 || batch.output.empty()) return {batch};
    std::vector<BatchRequest> out;
    batch.leave_out = batch.output;
    for (const std::string& style : a.styles) {
        batch.each.style = style;
        batch.output = batch.leave_out / load_style(style, batch.each.settings, batch.each.user_styles).name;
        for (const BatchRequest& other : out)
            if (other.output == batch.output)
                throw usage_error("--style " + style, "is given twice", "leave one of them out");
        out.push_back(batch);
    }
    return out;
}

}  // namespace dstylize::app
