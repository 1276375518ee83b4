#include "pipeline/manifest.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/error.h"
#include "pipeline/shard.h"
#include "support/temp_folder.h"

namespace dstylize {
namespace {

using Pictures = std::vector<std::string>;

TEST(Manifest, HoldsAnyName) {
    const Pictures names{"a.png", "sea/b c.jpg", "new\nline", "back\\slash\\n", "\xff\xfe.png", "# hash", "..dots/..x"};
    EXPECT_EQ(parsed_manifest(manifest_text(names), "m").pictures, names);
    EXPECT_EQ(parsed_manifest(manifest_text({}), "m").pictures, Pictures{});
}

TEST(Manifest, IsRefusedInEveryLengthButItsOwn) {
    const std::string text = manifest_text({"a.png", "b.png", "c.png"});
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_THROW(parsed_manifest(std::string_view(text).substr(0, length), "m"), Error) << length;
}

TEST(Manifest, LeadsNowhereElse) {
    for (const char* path : {"../a", "/a", "a/../../b", "a/", "", "x\\y", "./a", "a//b"})
        EXPECT_THROW(parsed_manifest(std::string("# dstylize manifest 1, pictures: 1\n") + path + "\n", "m"), Error)
            << path;
}

TEST(Manifest, OfManyMakersIsOne) {
    const test::TempFolder folder;
    constexpr int kMakers = 8;
    std::vector<Manifest> made(kMakers);
    {
        std::vector<std::jthread> makers;
        for (int k = 0; k < kMakers; ++k)
            makers.emplace_back([&, k] {
                made[std::size_t(k)] = frozen_manifest(folder / "m", [k] { return Pictures{std::to_string(k)}; });
            });
    }
    for (const Manifest& one : made) EXPECT_EQ(one.xxh128, made[0].xxh128);
    EXPECT_EQ(folder.names(), std::set<std::string>{"m"});
}

TEST(Shards, DivideAList) {
    for (const std::size_t total : {0u, 1u, 7u, 12u}) {
        std::vector<int> times(total);
        for (int k = 1; k <= 5; ++k)
            for (const std::size_t entry : shard_entries({k, 5}, total)) ++times.at(entry);
        EXPECT_EQ(times, std::vector<int>(total, 1));
    }
}

}  // namespace
}  // namespace dstylize
