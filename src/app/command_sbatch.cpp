#include <fmt/format.h>

#include <algorithm>

#include "app/child_process.h"
#include "app/commands.h"
#include "app/requests.h"
#include "pipeline/ledger.h"
#include "pipeline/outputs.h"
#include "pipeline/slurm_script.h"

namespace dstylize::app {
namespace {

namespace fs = std::filesystem;

constexpr int kShardsPerNode = 4;
constexpr int kMostShards = 1000;  // of an array that Slurm takes as it comes (MaxArraySize)

void check_sbatch(const Arguments& arguments) {
    if (arguments.names.size() != 2)
        throw Error(ErrorCode::bad_usage, "sbatch", "wants a folder of pictures and one for the drawings",
                    "write dstylize sbatch IN OUT --nodes N");
    if (arguments.nodes < 1)
        throw Error(ErrorCode::bad_usage, "sbatch", "does not know how many machines to use", "give --nodes N");
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=:,.;/+@%*[]";
    for (const std::string& option : arguments.slurm)
        if (!option.starts_with("--") || option.find_first_not_of(kPlain) != std::string::npos)
            throw Error(ErrorCode::bad_usage, "--slurm " + option, "is no plain option of sbatch",
                        "write --slurm=--NAME=VALUE, without spaces and quotes");
}

/// No link leads what is written, removed or taken over out of the folder of the drawings.
void check_links(const fs::path& output) {
    std::error_code ignored;
    if (!fs::exists(output, ignored)) return;
    for (const char* own : {".dstylize", ".dstylize/manifest", ".dstylize/shards", ".dstylize/slurm"})
        check_inside(output, output / own);
}

/// Makes the manifest, and says how many pictures it has. One of our own is made anew: what earlier shards have drawn
/// goes into the common ledger, so that no other shard draws it again.
std::size_t frozen_pictures(const std::vector<BatchRequest>& batches, bool own_manifest) {
    std::size_t listed = 0;
    for (BatchRequest batch : batches) {
        batch.each.dry_run = true;
        listed = batch_pictures(batch).pictures.size();
    }
    const BatchRequest& first = batches.front();
    if (first.each.dry_run) return listed;
    std::error_code ignored;
    if (own_manifest) {
        fs::create_directories(first.manifest.parent_path(), ignored);
        fs::remove(first.manifest, ignored);
        for (const BatchRequest& batch : batches) Ledger(batch.output, std::nullopt).take_over_shards();
    }
    return batch_pictures(first).pictures.size();
}

/// The number that sbatch gave a job.
std::string submitted(std::vector<std::string> options, const fs::path& script) {
    options.insert(options.begin(), {"sbatch", "--parsable"});
    options.push_back(script.string());
    const std::string said = output_of(options);
    std::string id = said.substr(0, said.find_first_not_of("0123456789"));
    if (id.empty()) throw Error(ErrorCode::failed, "sbatch", "names no job", "see squeue");
    return id;
}

}  // namespace

void write_slurm_jobs(const Arguments& arguments, const Parser& parser) {
    check_sbatch(arguments);
    const fs::path output = arguments.names[1], own = output / ".dstylize";
    Arguments with_manifest = arguments;
    if (arguments.manifest.empty()) with_manifest.manifest = own / "manifest";
    const std::vector<BatchRequest> batches = folder_requests(with_manifest);
    check_links(output);
    for (const BatchRequest& batch : batches) check_links(batch.output);

    SlurmRun run;
    run.nodes = arguments.nodes;
    const int wanted = arguments.shards > 0 ? arguments.shards : std::min(kMostShards, kShardsPerNode * run.nodes);
    const std::size_t pictures = frozen_pictures(batches, arguments.manifest.empty());
    run.shards = int(std::clamp<std::size_t>(pictures, 1, std::size_t(wanted)));
    run.program = fs::read_symlink("/proc/self/exe");
    run.folder = fs::current_path();
    run.own = own / "slurm";
    run.drawing = arguments.names;
    for (std::string& word : parser.given_options({"nodes", "shards", "slurm", "submit", "manifest", "dry-run"}))
        run.drawing.push_back(std::move(word));
    run.drawing.push_back("--manifest=" + with_manifest.manifest);
    for (const BatchRequest& batch : batches) run.outputs.push_back(batch.output);
    run.slurm = arguments.slurm;
    if (arguments.dry_run) return print(slurm_array_script(run) + "\n" + slurm_merge_script(run));

    const SlurmScripts scripts = write_slurm_scripts(run);
    if (!arguments.submit)
        return print(fmt::format("array=$(sbatch --parsable {})\nsbatch --dependency=afterany:$array {}\n",
                                 shell_word(scripts.array.string()), shell_word(scripts.merge.string())));
    const std::string array_job = submitted({}, scripts.array);
    const std::string merge_job = submitted({"--dependency=afterany:" + array_job}, scripts.merge);
    print(fmt::format("submitted array {} of {} shards, and {} that merges their reports\n", array_job, run.shards,
                      merge_job));
}

}  // namespace dstylize::app
