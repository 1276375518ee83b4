#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dstylize {

/// What both jobs of a Slurm run need to know.
struct SlurmRun {
    std::filesystem::path program;               ///< dstylize, as the nodes find it
    std::filesystem::path folder;                ///< in which the names below, and those in `drawing`, are meant
    std::filesystem::path own;                   ///< folder for the scripts and what they say
    std::vector<std::string> drawing;            ///< IN, OUT and options
    std::vector<std::filesystem::path> outputs;  ///< folders whose reports are merged
    std::vector<std::string> slurm;              ///< options of sbatch, checked
    int nodes = 1, shards = 1;
};

/// One word of a shell's command line, whatever is in it.
std::string shell_word(const std::string& text);

/// The job array: a task for each shard. A task whose node dies is started again by Slurm, one that fails by itself, a
/// few times; it goes on where it was.
std::string slurm_array_script(const SlurmRun& run);
/// The job that merges the reports, for after the array.
std::string slurm_merge_script(const SlurmRun& run);

struct SlurmScripts {
    std::filesystem::path array, merge;
};
/// Writes both into `own`, and returns their absolute names. Throws Error(cannot_write).
SlurmScripts write_slurm_scripts(const SlurmRun& run);

}  // namespace dstylize
