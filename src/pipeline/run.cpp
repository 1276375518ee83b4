// One picture from file to files. Everything that can be refused without computing is refused first, and
// nothing is written before every output is made.
#include "pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "formats/files.h"
#include "imaging/filters.h"
#include "pipeline/content_hash.h"
#include "pipeline/control_text.h"
#include "pipeline/deliver.h"
#include "pipeline/outputs.h"
#include "pipeline/run_recipe.h"
#include "pipeline/scene.h"
#include "pipeline/stylize.h"
#include "render/raster.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

/// The progress of one part as a share of the whole.
Work part(const Work& work, double from, double to) {
    Work inner = work;
    if (work.progress)
        inner.progress = [&work, from, to](std::string_view step, double share) {
            work.progress(step, from + (to - from) * share);
        };
    return inner;
}

std::string name_of(const fs::path& path) {
    return path == "-" ? "standard input" : path.empty() ? "paper" : path.string();
}

struct ReadFile {
    std::vector<std::byte> bytes;
    FileMark mark;
};

class Run {
  public:
    Run(const RunRequest& request, PictureCodec& codec, const Work& work)
        : request_(request), codec_(codec), work_(work) {}

    RunReport report() {
        check_place();
        load_style();
        recipe_ = recipe_of(request_, style_toml(style_));  // but for the files' marks
        plan_outputs();
        work_.report("reading", 0);
        read_inputs();
        check_memory();
        describe();
        if (request_.dry_run) return std::move(report_);
        std::vector<std::vector<std::byte>> files = request_.show.empty() ? drawn_files() : shown_files();
        work_.report("writing", 0.98);
        write(files);
        return std::move(report_);
    }

  private:
    void check_place() const {
        const Background::Kind kind = request_.background.kind;
        if (request_.place && kind != Background::Kind::file && kind != Background::Kind::input)
            throw Error(ErrorCode::bad_usage, "", "--place: there is no picture to put the drawing in",
                        "give --background FILE");
        if (request_.place && !request_.show.empty())
            throw Error(ErrorCode::bad_usage, "",
                        "--show " + request_.show + ": is of the drawing alone, and --place puts it into a background",
                        "leave one of them out");
    }

    void load_style() {
        std::vector<Setting> settings = request_.settings;
        if (request_.detail > 0) settings.push_back({"lattice.detail", std::to_string(request_.detail)});
        style_ = request_.style_toml ? parse_style(*request_.style_toml, request_.style, settings, request_.user_styles)
                                     : dstylize::load_style(request_.style, settings, request_.user_styles);
        if (request_.show.empty()) return;
        const std::vector<std::string> known = shown_names(style_);
        if (std::find(known.begin(), known.end(), request_.show) != known.end()) return;
        const std::string near = nearest_name(request_.show, known);
        throw Error(
            ErrorCode::bad_usage, "", "--show " + request_.show + ": there is nothing of that name to show",
            near.empty() ? "`dstylize styles --fields` lists what can be shown" : "did you mean '" + near + "'?");
    }

    void plan_outputs() {
        std::error_code ignored;
        if (!request_.input.empty() && request_.input != "-" && !fs::exists(request_.input, ignored))
            throw Error(ErrorCode::cannot_read, name_of(request_.input), "no such file", "check its name");
        const std::vector<fs::path> inputs{request_.input,          request_.importance.path, request_.mask.path,
                                           request_.endpoints.path, request_.background.file, request_.style};
        outputs_ = planned_outputs(request_.outputs, request_.format, inputs, request_.force);
        if (!request_.recipe_file.empty()) check_target(request_.recipe_file, inputs, request_.force);
        for (const PlannedOutput& output : outputs_) {
            if (!request_.show.empty() && output.format->holds != Holds::picture)
                throw Error(ErrorCode::bad_usage, output.name(), "--show makes a picture",
                            "write a png, jpg, tif or webp");
            if (request_.background.kind == Background::Kind::none && output.format->holds != Holds::skeleton &&
                !output.format->alpha)
                throw Error(ErrorCode::bad_usage, output.name(),
                            fmt::format("{} cannot be transparent", output.format->name),
                            "write png, tif, webp, svg or pdf, or give another --background");
        }
    }

    ReadFile file(const fs::path& path, const std::string& expected_xxh128 = "") {
        ReadFile out{read_file(path, request_.max_memory_bytes), {}};
        out.mark = {path.string(), content_hash(out.bytes)};
        if (!expected_xxh128.empty() && expected_xxh128 != out.mark.xxh128)
            throw Error(ErrorCode::cannot_read, name_of(path), "is not the file that the recipe names",
                        "bring back the one of that content");
        return out;
    }

    Picture picture(const AuxiliaryFile& auxiliary, std::optional<FileMark>& mark) {
        ReadFile read = file(auxiliary.path, auxiliary.xxh128);
        mark = read.mark;
        return codec_.decode(read.bytes, name_of(auxiliary.path)).picture;
    }

    void read_inputs() {
        if (!request_.mask.path.empty()) controls_.mask = picture(request_.mask, recipe_.mask);
        if (request_.input.empty()) {
            input_.picture = Picture(paper(), {255, 255, 255, 255});
        } else {
            ReadFile read = file(request_.input);
            recipe_.input = {request_.input.filename().string(), read.mark.xxh128};
            input_ = codec_.decode(read.bytes, name_of(request_.input));
            report_.decoder = input_.confinement;
        }
        if (request_.writing) controls_.mask = letter_mask(*request_.writing, input_.picture.extent());
        lattice_ =
            lattice_scale(input_.picture.extent(), style_.lattice, controls_.mask ? &*controls_.mask : nullptr).extent;
        controls_.seed = request_.seed;
        controls_.roots = request_.roots;
        controls_.importance_replaces = request_.importance_replaces;
        controls_.no_picture = request_.no_picture;
        if (!request_.importance.path.empty()) controls_.importance = picture(request_.importance, recipe_.importance);
        if (!request_.endpoints.path.empty()) read_endpoints();
        if (request_.background.kind == Background::Kind::file)
            ground_ = picture({request_.background.file, request_.background_xxh128}, recipe_.background_file);
        if (request_.background.kind == Background::Kind::input) ground_ = input_.picture;
        if (request_.place) box_ = placed_box(*request_.place, ground_.extent());
        frame_ = framed(request_.place ? ground_.extent() : input_.picture.extent());
    }

    /// The output for a picture of this size. One that is too large by itself is the picture's fault.
    OutputFrame framed(Extent whole) const {
        const bool in_file = request_.place && request_.background.kind == Background::Kind::file;
        if (request_.size.kind == OutputSize::Kind::as_input && whole.long_side() > kLongestDrawing_px)
            throw Error(
                ErrorCode::cannot_read, name_of(in_file ? request_.background.file : request_.input),
                fmt::format("is {} pixels long, and a drawing at most {}", whole.long_side(), kLongestDrawing_px),
                "ask for a smaller --size");
        return output_frame(request_.size, whole);
    }

    /// The size of the paper where there is no input picture.
    Extent paper() const {
        if (request_.writing) return paper_extent(*request_.writing);
        if (controls_.mask) return controls_.mask->extent();
        throw Error(ErrorCode::bad_usage, "", "no picture is named", "give one, or words to write, or a mask");
    }

    void read_endpoints() {
        const ReadFile read = file(request_.endpoints.path, request_.endpoints.xxh128);
        const std::string name = name_of(request_.endpoints.path);
        recipe_.endpoints = read.mark;
        controls_.endpoints =
            endpoint_rows({reinterpret_cast<const char*>(read.bytes.data()), read.bytes.size()}, name);
        std::vector<std::string> stages;
        for (const StageParameters& stage : style_.stages) stages.push_back(stage.name);
        check_endpoints(controls_.endpoints, input_.picture.extent(), stages, name);
    }

    struct Need {
        double bytes;
        const char* remedy;
    };
    /// The picture, fields, labels and queues; with directions also a height for each edge, on irregular lattices a
    /// list of edges.
    double bytes_per_node() const {
        constexpr double kOfWeights = 42, kOfDirections = 130, kOfLists = 330;
        if (style_.lattice.kind != LatticeParameters::Kind::regular || style_.lattice.jitter > 0) return kOfLists;
        const auto has_directions = [](const StageParameters& s) {
            return s.along_flow > 0 || s.down != 0 || s.up != 0 || s.wind != 0;
        };
        return std::any_of(style_.stages.begin(), style_.stages.end(), has_directions) ? kOfDirections : kOfWeights;
    }
    /// The greatest of what the steps of a run hold; measured, and rounded up.
    Need most_memory() const {
        // Raster, shared memory and encoder per output pixel, in a place also its ground and cover at that size.
        constexpr double kBytesPerPixel = 16, kBytesPerPlacedPixel = 24;
        const SceneMemory scene = request_.place ? scene_memory(ground_.extent(), style_.scene) : SceneMemory{};
        const double pixels = request_.show.empty() && rasters() ? double(frame_.size_px.count()) : 0;
        const double painting = pixels * (request_.place ? kBytesPerPlacedPixel : kBytesPerPixel) + scene.kept;
        const std::array needs{
            Need{painting, "ask for a smaller --size, or raise --max-memory"},
            Need{double(lattice_.count()) * bytes_per_node(), "ask for less --detail, or raise --max-memory"},
            Need{scene.peak, "give a smaller background or --set scene.painted=0, or raise --max-memory"}};
        return *std::max_element(needs.begin(), needs.end(),
                                 [](const Need& a, const Need& b) { return a.bytes < b.bytes; });
    }

    void check_memory() const {
        if (const Need most = most_memory(); most.bytes > double(request_.max_memory_bytes))
            throw Error(ErrorCode::bad_usage, name_of(request_.input),
                        fmt::format("needs about {:.1f} GiB of memory", most.bytes / double(1u << 30)), most.remedy);
        for (const PlannedOutput& output : outputs_) {
            const int most = most_pixels(output.format->id), side = frame_.size_px.long_side();
            if (output.format->holds == Holds::picture && request_.show.empty() && side > most)
                throw Error(ErrorCode::bad_usage, output.name(),
                            fmt::format("{} pixels are more than {} holds ({})", side, output.format->name, most),
                            "ask for a smaller --size, or write a png or tif");
        }
    }
    bool rasters() const {
        return std::any_of(outputs_.begin(), outputs_.end(),
                           [](const PlannedOutput& o) { return o.format->holds == Holds::picture; });
    }

    /// Fills in what is known of the report before anything is drawn.
    void describe() {
        report_.input = name_of(request_.input);
        report_.input_xxh128 = recipe_.input.xxh128;
        report_.style = style_.name;
        report_.seed = request_.seed;
        report_.picture = input_.picture.extent();
        report_.lattice = lattice_;
        report_.recipe = recipe_toml(recipe_);
        report_.dry_run = request_.dry_run;
        for (const PlannedOutput& output : outputs_)
            report_.outputs.push_back({output.name(), std::string(output.format->name),
                                       request_.show.empty() ? frame_.size_px : report_.lattice, 0, output.replaces});
    }

    DeliveryOptions delivery_options() const {
        DeliveryOptions options;
        options.frame = frame_;
        options.quality = request_.quality;
        options.compression = request_.compression;
        const std::string subject = request_.writing              ? request_.writing->lettering.text
                                    : !recipe_.input.name.empty() ? fs::path(recipe_.input.name).stem().string()
                                                                  : request_.mask.path.stem().string();
        options.title = fmt::format("{} ({})", subject, style_.name);
        options.metadata.dpi = input_.metadata.dpi;
        for (const char* key : {"author", "copyright", "description"})
            if (const std::string text = input_.metadata.find(key); !text.empty())
                options.metadata.text.emplace_back(key, text);
        options.metadata.text.emplace_back("software", recipe_.program);
        if (request_.keep_recipe) options.metadata.text.emplace_back("recipe", report_.recipe);
        return options;
    }

    void lay_ground(Paper& paper) {
        switch (request_.background.kind) {
            case Background::Kind::style: return;
            case Background::Kind::none:
                paper.colour.a = 0;
                paper.picture = nullptr;
                break;
            case Background::Kind::colour:
                paper.colour = request_.background.colour;
                paper.picture = nullptr;
                break;
            case Background::Kind::input:
            case Background::Kind::file: {
                Picture ground = middle_part(ground_, frame_.size_px);
                if (ground.extent().long_side() > frame_.size_px.long_side()) ground = resized(ground, frame_.size_px);
                paper.picture = std::make_shared<Picture>(std::move(ground));
                ground_ = {};
                break;
            }
        }
        paper.grain = 0;
    }

    /// The size of a small copy.
    Extent small(Extent e) const { return lattice_extent(e, std::min(request_.thumbnail_px, e.long_side())); }

    std::vector<std::vector<std::byte>> drawn_files() {
        Drawing drawing;
        try {
            drawing = stylize(input_.picture, style_, controls_, part(work_, 0.08, 0.85));
        } catch (const Error& error) {
            rethrow_named(error);
        }
        report_.unreached = drawing.unreached;
        report_.nodes = drawing.dendrite.size();
        report_.strokes = drawing.strokes;
        for (std::size_t s = 0; s < drawing.endpoints.size(); ++s)
            report_.endpoints.emplace_back(drawing.stage_names[s], drawing.endpoints[s]);
        if (request_.place)
            drawing.list = in_scene(drawing, std::exchange(ground_, {}), box_, style_.scene, request_.seed,
                                    part(work_, 0.85, 0.85));
        else
            lay_ground(drawing.list.paper);
        drawing.list.mixing = style_.scene.blend;
        const DeliveryOptions options = delivery_options();
        if (request_.thumbnail_px > 0) {
            report_.small_input = resized(input_.picture, small(input_.picture.extent()));
            report_.small_drawing = raster(drawing.list, {small(frame_.size_px)}, work_);
        }
        input_.picture = {};
        Delivery delivery(std::move(drawing), options, codec_);
        return each_output(
            [&](const PlannedOutput& output) { return delivery.file(*output.format, output.name(), work_); });
    }

    std::vector<std::vector<std::byte>> shown_files() {
        Picture picture;
        try {
            picture = shown({request_.show}, input_.picture, style_, controls_, part(work_, 0.08, 0.85)).front();
        } catch (const Error& error) {
            rethrow_named(error);
        }
        if (request_.thumbnail_px > 0) {
            report_.small_input = resized(input_.picture, small(input_.picture.extent()));
            report_.small_drawing = resized(picture, small(picture.extent()));
        }
        DeliveryOptions options = delivery_options();
        options.frame = {picture.extent(), 0, 0, 0};
        options.metadata.dpi = 0;
        return each_output([&](const PlannedOutput& output) {
            return picture_file(picture, *output.format, options, codec_, output.name());
        });
    }

    template <class Make>
    std::vector<std::vector<std::byte>> each_output(Make make) {
        std::vector<std::vector<std::byte>> files;
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            work_.report("painting " + outputs_[i].name(), 0.85 + 0.13 * double(i) / double(outputs_.size()));
            files.push_back(make(outputs_[i]));
        }
        return files;
    }

    /// Growth knows pictures, not files: what it cannot do is the mask's fault if there is one.
    [[noreturn]] void rethrow_named(const Error& error) const {
        if (!error.file().empty() || error.code() == ErrorCode::cancelled) throw error;
        const bool about_mask = error.code() == ErrorCode::failed && !request_.mask.path.empty();
        throw Error(error.code(), name_of(about_mask ? request_.mask.path : request_.input), error.problem(),
                    error.remedy());
    }

    void write(const std::vector<std::vector<std::byte>>& files) {
        for (std::size_t i = 0; i < files.size(); ++i) {
            work_.check();
            write_file_atomically(outputs_[i].path, files[i]);
            report_.outputs[i].bytes = files[i].size();
        }
        if (!request_.recipe_file.empty())
            write_file_atomically(request_.recipe_file, std::as_bytes(std::span(report_.recipe)));
    }

    const RunRequest& request_;
    PictureCodec& codec_;
    const Work& work_;
    Style style_;
    std::vector<PlannedOutput> outputs_;
    DecodedPicture input_;
    OutputFrame frame_;
    Extent lattice_;
    Controls controls_;
    Picture ground_;
    Box box_;
    Recipe recipe_;
    RunReport report_;
};

}  // namespace

RunReport run(const RunRequest& request, PictureCodec& codec, const Work& work) {
    return Run(request, codec, work).report();
}

}  // namespace dstylize
