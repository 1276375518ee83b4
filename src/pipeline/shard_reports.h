#pragma once
#include <filesystem>

#include "pipeline/batch.h"

namespace dstylize {

/// Removes the report of the shard's last run, so that a shard that dies has none.
void remove_shard_report(const std::filesystem::path& output, Shard shard);

/// Writes what a shard did, for merge_shards. Throws Error(cannot_write).
void write_shard_report(const BatchReport& report, const std::filesystem::path& input,
                        const std::filesystem::path& output, Shard shard);

/// Makes of the reports of all shards that of the whole run, with report.json, index.html and the common ledger in the
/// output folder, as one machine would have made them. Can be repeated.
/// Throws Error(cannot_read) when reports are missing, damaged or of different runs: it says which;
/// Error(cannot_write).
BatchReport merge_shards(const std::filesystem::path& output);

}  // namespace dstylize
