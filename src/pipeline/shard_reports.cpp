#include "pipeline/shard_reports.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.h"
#include "formats/files.h"
#include "pipeline/batch_report.h"
#include "pipeline/ledger.h"
#include "pipeline/outputs.h"
#include "pipeline/path_json.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using State = BatchPicture::State;

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& remedy) {
    throw Error(ErrorCode::cannot_read, file.string(), problem, remedy);
}

/// Into how many shards the run in the folder was divided.
int count_of_shards(const fs::path& output) {
    const fs::path shards = shard_folder(output, 1).parent_path();
    std::vector<fs::path> runs;
    std::error_code ignored;
    for (fs::directory_iterator at(shards, ignored), end; at != end; at.increment(ignored)) runs.push_back(at->path());
    if (runs.empty())
        refuse(output, "has no reports of shards",
               "run them with --shard K/N; of several styles, name the folder of each");
    if (runs.size() > 1)
        refuse(shards, "has reports of runs with different numbers of shards",
               "remove the folders of those that are over");
    try {
        return parsed_shard("1/" + runs.front().filename().string()).count;
    } catch (const Error&) {
        refuse(runs.front(), "is no folder of a run", "remove it");
    }
}

BatchPicture picture_of(const ordered_json& row) {
    BatchPicture picture{path_from_json(row.at("input")), {}, State::failed, {}, {}};
    for (const ordered_json& result : row.at("results")) picture.results.push_back(path_from_json(result));
    if (picture.results.empty()) throw std::invalid_argument("no results");
    const std::string state = row.at("state");
    if (state == "failed") {
        picture.problem = row.at("problem");
        picture.remedy = row.at("remedy");
    } else if (state == "done" || state == "up to date") {
        picture.state = state == "done" ? State::done : State::up_to_date;
    } else {
        throw std::invalid_argument("no state that a finished shard leaves");
    }
    return picture;
}

struct ShardReport {
    BatchReport report;
    fs::path input;  ///< from the output folder
};

ShardReport read_report(const fs::path& file, Shard shard) {
    const std::vector<std::byte> bytes = read_file(file, std::numeric_limits<std::uint64_t>::max());
    try {
        const auto* text = reinterpret_cast<const char*>(bytes.data());
        const ordered_json tree = ordered_json::parse(text, text + bytes.size());
        ShardReport out;
        out.report.style = tree.at("style");
        for (const ordered_json& row : tree.at("pictures")) out.report.pictures.push_back(picture_of(row));
        const ordered_json& run = tree.at("run");
        out.report.all = run.at("pictures");
        out.report.key = run.at("key");
        out.report.manifest_xxh128 = run.at("manifest");
        out.input = path_from_json(run.at("input"));
        if (out.report.pictures.size() == shard_entries(shard, out.report.all).size()) return out;
    } catch (const std::exception&) {
        // Said below.
    }
    refuse(file, "is no report of a shard", fmt::format("run shard {}/{} again", shard.index, shard.count));
}

std::string listed(const std::vector<int>& shards) { return fmt::format("{}", fmt::join(shards, ",")); }

}  // namespace

void remove_shard_report(const fs::path& output, Shard shard) {
    std::error_code ignored;
    if (!fs::exists(output, ignored)) return;
    check_inside(output, shard_report(output, shard));
    fs::remove(shard_report(output, shard), ignored);
}

void write_shard_report(const BatchReport& report, const fs::path& input, const fs::path& output, Shard shard) {
    ordered_json tree = ordered_json::parse(batch_report_json(report));
    const fs::path from = fs::proximate(fs::absolute(input), fs::absolute(output));
    tree["run"] = {{"pictures", report.all},
                   {"key", report.key},
                   {"manifest", report.manifest_xxh128},
                   {"input", path_json<ordered_json>(from.string())}};
    const std::string text = tree.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    check_inside(output, shard_report(output, shard));
    write_file_atomically(shard_report(output, shard), std::as_bytes(std::span(text)));
}

BatchReport merge_shards(const fs::path& output) {
    const int count = count_of_shards(output);
    std::vector<int> missing;
    std::error_code ignored;
    for (int k = 1; k <= count; ++k)
        if (!fs::exists(shard_report(output, {k, count}), ignored)) missing.push_back(k);
    if (!missing.empty())
        refuse(shard_folder(output, count), fmt::format("no report of shard {} of {}", listed(missing), count),
               "run it again; as a Slurm array: sbatch --array=" + listed(missing));

    ShardReport whole = read_report(shard_report(output, {1, count}), {1, count});
    const auto same_run = [&](const BatchReport& other) {
        return other.key == whole.report.key && other.manifest_xxh128 == whole.report.manifest_xxh128 &&
               other.all == whole.report.all && other.style == whole.report.style;
    };
    std::vector<BatchPicture> pictures(whole.report.all);
    for (int k = 1; k <= count; ++k) {
        const Shard shard{k, count};
        ShardReport part = read_report(shard_report(output, shard), shard);
        if (!same_run(part.report))
            refuse(shard_report(output, shard), "is of another run than the first shard's",
                   "run all shards with the same options and manifest");
        const std::vector<std::size_t> entries = shard_entries(shard, pictures.size());
        for (std::size_t e = 0; e < entries.size(); ++e) pictures[entries[e]] = std::move(part.report.pictures[e]);
    }
    whole.report.pictures = std::move(pictures);
    check_batch_reports(output, false);
    Ledger ledger(output, std::nullopt);
    check_inside(output, ledger.file());
    ledger.compact();
    write_batch_reports(whole.report, output / whole.input, output);
    return std::move(whole.report);
}

}  // namespace dstylize
