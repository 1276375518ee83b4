// A folder as one run: which results are up to date is settled picture by picture, just before it would be drawn, by
// its bytes and by a key of everything else that shapes a result.
#include "pipeline/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <tuple>

#include "formats/files.h"
#include "formats/format.h"
#include "pipeline/batch_report.h"
#include "pipeline/content_hash.h"
#include "pipeline/deliver.h"
#include "pipeline/folder_listing.h"
#include "pipeline/ledger.h"
#include "pipeline/outputs.h"
#include "pipeline/result_names.h"
#include "pipeline/run_recipe.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
using State = BatchPicture::State;

std::string hash_of(std::string_view text) { return content_hash(std::as_bytes(std::span(text))); }

/// 60 of the hash's bits, which --seed can take, too: a picture's chance depends on its path and the run's seed alone.
std::uint64_t own_seed(std::uint64_t seed, const fs::path& relative) {
    return std::stoull(hash_of(fmt::format("{} {}", seed, relative.generic_string())).substr(0, 15), nullptr, 16);
}

/// Whether the name has an extension of a format that we write.
bool is_file_name(const fs::path& path) {
    try {
        format_for(path);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// The folder in which all results lie, those of other styles as well.
const fs::path& root_of(const BatchRequest& request) {
    return request.leave_out.empty() ? request.output : request.leave_out;
}

/// However both are named.
bool lies_in(const fs::path& inner, const fs::path& outer) {
    std::error_code error;
    fs::path at = fs::canonical(inner, error);
    while (!error && at.has_relative_path()) {
        at = at.parent_path();
        std::error_code ignored;
        if (fs::equivalent(at, outer, ignored)) return true;
    }
    return false;
}

/// Results may lie in a folder of the input, which is then left out of it. If they lay around it, a drawing could get
/// the name of an original.
void check_folders(const BatchRequest& request) {
    const fs::path& output = root_of(request);
    const std::string name = output.string();
    std::error_code ignored;
    if (!fs::is_directory(request.input, ignored))
        throw Error(ErrorCode::cannot_read, request.input.string(), "is no folder", "give a folder of pictures");
    if (name.empty() || name == "-")
        throw Error(ErrorCode::bad_usage, request.input.string(), "is a folder, and its drawings need one", "give OUT");
    if (fs::exists(output, ignored) && !fs::is_directory(output, ignored))
        throw Error(ErrorCode::bad_usage, name, "is a file, and the input is a folder",
                    "give a folder for the drawings");
    if (!fs::exists(output, ignored) && is_file_name(output))
        throw Error(ErrorCode::bad_usage, name, "names a file, and the input is a folder",
                    "give a folder for the drawings");
    if (fs::equivalent(request.input, output, ignored))
        throw Error(ErrorCode::bad_usage, name, "is also the input", "give another folder for the drawings");
    if (lies_in(request.input, output))
        throw Error(ErrorCode::bad_usage, name, "contains the input, " + request.input.string(),
                    "give a folder for the drawings that does not; it may lie in the input");
    if (!request.each.outputs.empty() || !request.each.recipe_file.empty())
        throw Error(ErrorCode::bad_usage, request.input.string(), "is a folder, and -o and --recipe name single files",
                    "give --format for another kind of result");
}

std::vector<std::string> formats_of(const BatchRequest& request) {
    if (request.formats.empty()) return {"png"};
    for (auto format = request.formats.begin(); format != request.formats.end(); ++format)
        for (auto other = request.formats.begin(); other != format; ++other)
            if (format_named(*other).id == format_named(*format).id)
                throw Error(ErrorCode::bad_usage, "--format " + *format, "is given twice", "leave one of them out");
    format_named(request.formats.front());
    return request.formats;
}

Style style_of(const BatchRequest& request) {
    return load_style(request.each.style, request.each.settings, request.each.user_styles);
}

std::vector<std::string> listed(const BatchRequest& request) {
    std::vector<std::string> pictures;
    for (const fs::path& picture : pictures_in(request.input, request.patterns, root_of(request)))
        pictures.push_back(picture.string());
    if (pictures.empty() && !request.only)
        throw Error(ErrorCode::cannot_read, request.input.string(), "has no pictures",
                    "give another folder, or patterns of names with --include");
    return pictures;
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error(ErrorCode::cannot_write, folder.string(), "cannot be made (" + error.message() + ")",
                    "check the folder's permissions");
}

/// Everything that shapes a result beside the picture's bytes, its own seed and its format, as text.
std::string settings_of(const RunRequest& each, const std::string& style) {
    Recipe recipe = recipe_of(each, style);
    const auto mark = [&](const fs::path& path, std::optional<FileMark>& file) {
        if (!path.empty()) file = {path.string(), content_hash(read_file(path, each.max_memory_bytes))};
    };
    mark(each.importance.path, recipe.importance);
    mark(each.mask.path, recipe.mask);
    mark(each.endpoints.path, recipe.endpoints);
    mark(each.background.file, recipe.background_file);
    return fmt::format("{}\n{} {} {} {} {}", recipe_toml(recipe), each.detail, each.show, each.quality,
                       each.compression, each.keep_recipe);
}

constexpr int kThumbnail_px = 480;

class Batch {
  public:
    Batch(const BatchRequest& request, const std::function<void(const BatchProgress&)>& observer, const Work& work)
        : request_(request), observer_(observer), work_(work) {}

    BatchReport report() && {
        const Manifest manifest = batch_pictures(request_);
        report_.manifest_xxh128 = manifest.xxh128;
        Style style = style_of(request_);
        const std::vector<std::string> formats = formats_of(request_);
        const std::string settings = settings_of(request_.each, style_toml(style));
        for (const std::string& format : formats) keys_.push_back(hash_of(settings + format));
        report_.style = style.name;
        report_.all = manifest.pictures.size();
        report_.key = hash_of(fmt::format("{}\n{} {}", settings, fmt::join(formats, " "), request_.name));
        choose(manifest.pictures, {{request_.name, style.name, request_.each.seed, formats}, manifest.pictures});
        ledger_.emplace(request_.output, request_.shard);
        if (!request_.each.dry_run) {
            make_folder(root_of(request_));
            check_inside(root_of(request_), ledger_->file());
            make_folder(ledger_->file().parent_path());
            if (!request_.shard) check_batch_reports(request_.output, request_.each.force);
            ledger_->take_over_shards();
        }
        draw_all();
        if (!request_.each.dry_run && !work_.stop.stop_requested()) ledger_->compact();
        return std::move(report_);
    }

  private:
    void choose(const std::vector<std::string>& pictures, const ResultNames& names) {
        for (const std::size_t k : shard_entries(request_.shard.value_or(Shard()), pictures.size()))
            if (!request_.only || request_.only->contains(pictures[k]))
                report_.pictures.push_back({pictures[k], names.of(pictures[k]), State::not_reached, {}, {}});
    }

    /// First all, several at a time; then those that need more memory than their share, one by one.
    void draw_all() {
        constexpr std::uint64_t kMemoryOfOne = 1ull << 30;
        const auto threads =
            std::size_t(work_.threads > 0 ? work_.threads : std::max(1u, std::thread::hardware_concurrency()));
        const std::size_t most = std::max<std::size_t>(1, request_.each.max_memory_bytes / kMemoryOfOne);
        const std::size_t workers = std::max<std::size_t>(1, std::min({threads, most, report_.pictures.size()}));
        std::vector<std::size_t> all(report_.pictures.size());
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
        tell(progress());
        draw(all, workers, int(std::max<std::size_t>(1, threads / workers)));
        if (!postponed_.empty()) draw(std::exchange(postponed_, {}), 1, int(threads));
    }

    void draw(const std::vector<std::size_t>& pictures, std::size_t workers, int threads) {
        std::atomic<std::size_t> next{0};
        std::exception_ptr fault;
        const auto draw_some = [&] {
            try {
                CodecOptions share = request_.codec;
                share.max_memory_bytes /= workers;
                PictureCodec codec(share);
                for (std::size_t k; !work_.stop.stop_requested() && (k = next++) < pictures.size();)
                    finish(pictures[k], workers, threads, codec);
            } catch (...) {
                const std::scoped_lock lock(mutex_);
                if (!fault) fault = std::current_exception();
                next = pictures.size();
            }
        };
        {
            std::vector<std::jthread> others;
            for (std::size_t w = 1; w < workers; ++w) others.emplace_back(draw_some);
            draw_some();
        }
        if (fault) std::rethrow_exception(fault);
    }

    /// One picture, whatever becomes of it. What concerns the whole batch is thrown.
    void finish(std::size_t index, std::size_t workers, int threads, PictureCodec& codec) {
        BatchPicture& picture = report_.pictures[index];
        std::optional<RunReport> how;
        try {
            std::tie(picture.state, how) = drawn(picture, workers, threads, codec);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) return;
            // Reading, too, can fail for want of memory.
            const bool may_need_more = error.code() == ErrorCode::bad_usage || error.code() == ErrorCode::cannot_read;
            if (may_need_more && workers > 1) {
                const std::scoped_lock lock(mutex_);
                postponed_.push_back(index);
                return;
            }
            picture.state = State::failed;
            const bool is_of_input = error.file().empty() || error.file() == request_.input / picture.input;
            picture.problem = is_of_input ? error.problem() : fmt::format("{}: {}", error.file(), error.problem());
            picture.remedy = error.remedy();
        } catch (const std::bad_alloc&) {
            picture.state = State::failed;
            picture.problem = "out of memory";
            picture.remedy = "ask for less --detail or a smaller --size";
        }
        const std::scoped_lock lock(mutex_);
        ++finished_;
        BatchProgress now = progress();
        now.picture = &picture;
        now.drawn = how ? &*how : nullptr;
        tell(now);
    }

    /// What became of it, and how where it was drawn.
    std::pair<State, std::optional<RunReport>> drawn(const BatchPicture& picture, std::size_t workers, int threads,
                                                     PictureCodec& codec) {
        RunRequest run_request = request_.each;
        run_request.max_memory_bytes /= workers;
        run_request.input = request_.input / picture.input;
        run_request.seed = own_seed(request_.each.seed, picture.input);
        run_request.format.clear();
        const std::string hash = content_hash(read_file(run_request.input, request_.each.max_memory_bytes));
        std::vector<std::size_t> stale;
        for (std::size_t r = 0; r < picture.results.size(); ++r)
            if (!is_up_to_date(picture.results[r], hash, keys_[r])) stale.push_back(r);
        if (stale.empty()) return {State::up_to_date, {}};
        if (request_.each.dry_run) return {State::done, {}};
        for (const std::size_t r : stale) {
            const fs::path target = request_.output / picture.results[r];
            check_inside(request_.output, target);
            make_folder(target.parent_path());
            check_target(target, {}, request_.each.force || is_as_made(picture.results[r]));
            run_request.outputs.push_back(target);
        }
        run_request.force = true;
        run_request.thumbnail_px = kThumbnail_px;
        RunReport made_now = run_one(picture, run_request, threads, codec);
        write_thumbnail(thumbnail_before(picture), made_now.small_input, codec);
        write_thumbnail(thumbnail_after(picture), made_now.small_drawing, codec);
        for (std::size_t k = 0; k < stale.size(); ++k)
            ledger_->add(picture.results[stale[k]], {hash, keys_[stale[k]], made_now.outputs[k].bytes});
        return {State::done, std::move(made_now)};
    }

    /// Judged by its size: if it is still what we made, we may replace it, with our mark in it or without.
    bool is_as_made(const std::string& result) const {
        const Ledger::Entry* const made = ledger_->find(result);
        std::error_code missing;
        const std::uintmax_t bytes = fs::file_size(request_.output / result, missing);
        return made && !missing && made->bytes == bytes;
    }

    bool is_up_to_date(const std::string& result, const std::string& hash, const std::string& key) const {
        const Ledger::Entry* const made = ledger_->find(result);
        return made && made->input_xxh128 == hash && made->key == key && is_as_made(result);
    }

    void write_thumbnail(const fs::path& relative, const Picture& small, PictureCodec& codec) const {
        const fs::path path = request_.output / relative;
        check_inside(request_.output, path);
        make_folder(path.parent_path());
        DeliveryOptions options;
        options.quality = 85;
        write_file_atomically(path, picture_file(small, format_named("jpg"), options, codec, path.string()));
    }

    RunReport run_one(const BatchPicture& picture, const RunRequest& run_request, int threads, PictureCodec& codec) {
        bool writing = false;
        Work work;
        work.stop = work_.stop;
        work.threads = threads;
        work.progress = [&](std::string_view step, double) { begin(picture, step, writing); };
        try {
            RunReport report = run(run_request, codec, work);
            begin(picture, "thumbnails", writing);
            return report;
        } catch (...) {
            begin(picture, {}, writing);
            throw;
        }
    }

    /// `writing`: whether it was writing its files before this step; then, whether it is.
    void begin(const BatchPicture& picture, std::string_view step, bool& writing) {
        const std::scoped_lock lock(mutex_);
        writing_ += int(step == "writing") - int(writing);
        writing = step == "writing";
        BatchProgress now = progress();
        now.at_work = &picture;
        now.step = step;
        tell(now);
    }
    BatchProgress progress() const {
        BatchProgress now;
        now.finished = finished_;
        now.total = report_.pictures.size();
        now.writing = writing_ > 0;
        return now;
    }
    void tell(const BatchProgress& now) const {
        if (observer_) observer_(now);
    }

    const BatchRequest& request_;
    const std::function<void(const BatchProgress&)>& observer_;
    const Work& work_;
    std::vector<std::string> keys_;  ///< of each of a picture's results
    BatchReport report_;
    std::optional<Ledger> ledger_;
    std::vector<std::size_t> postponed_;
    std::size_t finished_ = 0;
    int writing_ = 0;
    std::mutex mutex_;
};

}  // namespace

std::size_t BatchReport::count(State state) const {
    return std::size_t(std::count_if(pictures.begin(), pictures.end(),
                                     [state](const BatchPicture& picture) { return picture.state == state; }));
}

Manifest batch_pictures(const BatchRequest& request) {
    check_folders(request);
    const std::vector<std::string> formats = formats_of(request);
    const auto list = [&] {
        std::vector<std::string> pictures = listed(request);
        check_naming({request.name, style_of(request).name, request.each.seed, formats});
        return pictures;
    };
    std::error_code ignored;
    if (request.manifest.empty() || (request.each.dry_run && !fs::exists(request.manifest, ignored)))
        return {list(), {}};
    return frozen_manifest(request.manifest, list);
}

BatchReport run_batch(const BatchRequest& request, const std::function<void(const BatchProgress&)>& observer,
                      const Work& work) {
    return Batch(request, observer, work).report();
}

}  // namespace dstylize
