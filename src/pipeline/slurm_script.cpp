// Names stand in the scripts as quoted words only: #SBATCH lines have rules of their own, and comments end with a line.
#include "pipeline/slurm_script.h"

#include <fmt/format.h>

#include <span>

#include "formats/files.h"
#include "pipeline/version.h"

namespace dstylize {
namespace {

constexpr int kRetries = 3;

std::string head(const SlurmRun& run, const std::string& what, const std::string& options, const std::string& log) {
    std::string out = fmt::format("#!/bin/bash\n# {}, as written by dstylize {}.\n", what, version());
    out += "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=/dev/null\n#SBATCH --nodes=1\n" + options;
    for (const std::string& option : run.slurm) out += "#SBATCH " + option + "\n";
    return out + fmt::format("cd -- {} || exit 4\nexec >>{}/{} 2>&1\n", shell_word(run.folder.string()),
                             shell_word(run.own.string()), log);
}

}  // namespace

std::string shell_word(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::string slurm_array_script(const SlurmRun& run) {
    std::string out =
        head(run, "A Slurm job array that draws a folder of pictures",
             fmt::format("#SBATCH --job-name=dstylize\n#SBATCH --array=1-{}%{}\n#SBATCH --exclusive\n#SBATCH --mem=0\n",
                         run.shards, run.nodes),
             "shard-\"$SLURM_ARRAY_TASK_ID\".log");
    out += fmt::format("status=0\n{}", shell_word(run.program.string()));
    for (const std::string& word : run.drawing) out += fmt::format(" {}", shell_word(word));
    out += fmt::format(R"( --shard="$SLURM_ARRAY_TASK_ID/{}" || status=$?
# 5: some pictures are damaged, and would be again; the report names them. 2: the command itself is wrong.
if [ "$status" = 5 ]; then exit 0; fi
if [ "$status" != 0 ] && [ "$status" != 2 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {} ]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit "$status"
)",
                       run.shards, kRetries);
    return out;
}

std::string slurm_merge_script(const SlurmRun& run) {
    std::string out = head(run, "A Slurm job that merges the reports of all shards",
                           "#SBATCH --job-name=dstylize-merge\n#SBATCH --ntasks=1\n", "merge.log");
    out += fmt::format("exec {} merge-reports", shell_word(run.program.string()));
    for (const std::filesystem::path& output : run.outputs) out += fmt::format(" {}", shell_word(output.string()));
    return out + "\n";
}

SlurmScripts write_slurm_scripts(const SlurmRun& run) {
    std::error_code reported_by_write;
    std::filesystem::create_directories(run.own, reported_by_write);
    SlurmScripts scripts{std::filesystem::absolute(run.own / "array.sbatch"),
                         std::filesystem::absolute(run.own / "merge.sbatch")};
    const std::string array = slurm_array_script(run), merge = slurm_merge_script(run);
    write_file_atomically(scripts.array, std::as_bytes(std::span(array)));
    write_file_atomically(scripts.merge, std::as_bytes(std::span(merge)));
    return scripts;
}

}  // namespace dstylize
