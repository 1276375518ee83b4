#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "pipeline/shard.h"

namespace dstylize {

/// What a folder run has made: OUT/.dstylize/ledger.jsonl, a line for every result. Lines are appended as results are
/// written, so that a run that is stopped in any way goes on where it was; a line that is not whole counts as none.
/// A shard appends to a ledger of its own, since machines cannot append to one file, and knows the common one as well.
/// `add` may be called from several threads.
class Ledger {
  public:
    /// A result is what became of an input's content by everything else that shapes it.
    struct Entry {
        std::string input_xxh128, key;
        std::uint64_t bytes = 0;  ///< of the result's file
        friend bool operator==(const Entry&, const Entry&) = default;
    };

    /// Reads what there is: without a shard, of all shards. Throws Error(cannot_read).
    Ledger(const std::filesystem::path& output_folder, std::optional<Shard> shard);

    const std::filesystem::path& file() const { return file_; }

    /// The entry of a result, by its path from the output folder; null if there is none.
    const Entry* find(const std::string& result) const;
    /// Throws Error(cannot_write).
    void add(const std::string& result, const Entry& entry);
    /// Writes the ledger anew, without lines that later ones have replaced. Throws Error(cannot_write).
    void compact() const;
    /// Puts what shards have made into the common ledger, and removes their folder. Nothing in a shard's own.
    /// Throws Error(cannot_write).
    void take_over_shards() const;

  private:
    using Entries = std::map<std::string, Entry>;
    static void read(const std::filesystem::path& file, Entries& entries);

    std::filesystem::path file_, shards_;  ///< no `shards_` in a shard's own
    Entries entries_, common_;             ///< those of file_, and what a shard sees beside them
    mutable std::mutex mutex_;
};

}  // namespace dstylize
