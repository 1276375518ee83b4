// A disk or an allocation that fails, or a kill, at every moment: no false success, no broken file under a final name,
// and what was there before is still there. (Bars R3 and R4 of docs/reliability.md.)
#include <nlohmann/json.hpp>

#include <cerrno>
#include <csignal>
#include <map>

#include "contract/app/app_fixture.h"
#include "support/faults.h"
#include "support/sanitized.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const Words kStyle{"--style", "ink", "--detail", "48", "--threads", "1"};
Words drawing(Words names) {
    names.insert(names.end(), kStyle.begin(), kStyle.end());
    return names;
}

/// The content of every file below a folder, by its relative path.
Files files_in(const fs::path& folder) {
    Files files;
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder)] = file_bytes(entry.path());
    return files;
}

class FaultTest : public AppTest {
  protected:
    void SetUp() override {
        if (kSanitized) GTEST_SKIP() << "not with sanitizers";
    }
    Outcome faulty(Fault fault, const Words& words) const { return dstylize_with(fault, words, folder_.path()); }
    long calls(const char* kind, const Words& words) const { return calls_of(kind, words, folder_.path()); }
};

class DiskError : public FaultTest, public ::testing::WithParamInterface<int> {};

TEST_P(DiskError, LeavesTheOldPictureOrThePlaceAsItWas) {
    expect_done(run(drawing({"in.png", "whole.png"})));
    const std::string whole = file_bytes(folder_ / "whole.png");
    for (const bool replaces : {false, true}) {
        const fs::path out = folder_ / "out.png";
        const auto prepare = [&] {
            fs::remove(out);
            if (replaces) expect_done(run(drawing({"in.png", "out.png", "--seed", "7"})));
        };
        prepare();
        const std::string old = file_bytes(out);
        const auto names = folder_.names();
        const long moments = calls("files", drawing({"in.png", "out.png"}));
        ASSERT_GE(moments, 5);
        for (long at = 1; at <= moments; ++at) {
            SCOPED_TRACE("call " + std::to_string(at));
            prepare();
            const Outcome outcome = faulty({"files", at, GetParam()}, drawing({"in.png", "out.png"}));
            const std::string now = file_bytes(out);
            if (outcome.exit_code == 0) {  // there was another way
                EXPECT_EQ(outcome.err, "");
                EXPECT_TRUE(now == whole);
                continue;
            }
            expect_error(outcome, 4, {"out.png", "cannot be written"});
            // The last call makes the folder remember what is already in place, whole.
            EXPECT_TRUE(at < moments ? now == old : now == whole);
            if (at < moments) {
                EXPECT_EQ(folder_.names(), names);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Errors, DiskError, ::testing::Values(ENOSPC, EACCES, EIO), [](const auto& row) {
    return row.param == ENOSPC ? "no_space" : row.param == EACCES ? "no_permission" : "input_output";
});

/// A folder of two pictures, one of which is drawn already.
class FolderFault : public FaultTest {
  protected:
    const Words kDraw = drawing({"photos", "out"});

    void SetUp() override {
        FaultTest::SetUp();
        if (IsSkipped()) return;
        fs::create_directories(folder_ / "photos");
        write_png(folder_ / "photos/a.png", scene({60, 50}));
        expect_drawn();
        fs::copy(folder_ / "out", folder_ / "before", fs::copy_options::recursive);
        write_png(folder_ / "photos/b.png", scene({50, 60}));
        expect_drawn();
        whole_ = files_in(folder_ / "out");
        ASSERT_GE(whole_.size(), 9u);
        restore();
        moments_ = calls("files", kDraw);
        ASSERT_GE(moments_, 20);
    }
    void expect_drawn() const { EXPECT_EQ(run(kDraw).exit_code, 0); }
    void restore() const {
        fs::remove_all(folder_ / "out");
        fs::copy(folder_ / "before", folder_ / "out", fs::copy_options::recursive);
    }
    /// Everything under a final name is whole.
    void expect_nothing_broken() const {
        for (const auto& [name, content] : files_in(folder_ / "out")) {
            const fs::path path = name;
            if (path.extension() == ".tmp" || path.filename() == "ledger.jsonl") continue;
            if (path.filename() == "report.json")
                EXPECT_TRUE(nlohmann::json::accept(content)) << content;
            else if (path.filename() == "index.html")
                EXPECT_TRUE(content.ends_with("</section>\n")) << content;
            else
                EXPECT_TRUE(whole_.at(name) == content) << name;
        }
    }
    /// The next run makes everything as if nothing had been.
    void expect_mended() const {
        expect_drawn();
        Files files = files_in(folder_ / "out"), whole = whole_;
        for (const char* const varies : {"report.json", "index.html"}) files.erase(varies), whole.erase(varies);
        std::erase_if(files, [](const auto& file) { return fs::path(file.first).extension() == ".tmp"; });
        EXPECT_TRUE(files == whole);
    }

    Files whole_;
    long moments_ = 0;
};

TEST_F(FolderFault, AnErrorOfTheDiskIsNoFalseSuccess) {
    constexpr int kErrors[] = {ENOSPC, EACCES, EIO};
    for (long at = 1; at <= moments_; ++at) {
        SCOPED_TRACE("call " + std::to_string(at));
        restore();
        const Outcome outcome = faulty({"files", at, kErrors[at % 3]}, kDraw);
        expect_nothing_broken();
        if (outcome.exit_code != 0) {
            EXPECT_TRUE(outcome.exit_code == 4 || outcome.exit_code == 5) << outcome.exit_code;
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
            EXPECT_TRUE(outcome.err.starts_with("dstylize: ")) << outcome.err;
            expect_mended();
        } else {
            EXPECT_TRUE(files_in(folder_ / "out").at("b.png") == whole_.at("b.png"));
            EXPECT_EQ(files_in(folder_ / "out").size(), whole_.size());
        }
    }
}

TEST_F(FolderFault, AnErrorOfReadingIsNoFalseSuccess) {
    const long reads = calls("reads", kDraw);
    ASSERT_GE(reads, 4) << "the ledger and two pictures";
    int failed = 0;
    for (long at = 1; at <= reads; ++at) {
        SCOPED_TRACE("read " + std::to_string(at));
        restore();
        const Outcome outcome = faulty({"reads", at, EIO}, kDraw);
        expect_nothing_broken();
        if (outcome.exit_code != 0) {
            ++failed;
            EXPECT_TRUE(outcome.exit_code >= 3 && outcome.exit_code <= 5) << outcome.exit_code;
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        }
        expect_mended();
    }
    EXPECT_GE(failed, 3);
}

TEST_F(FolderFault, AKillAtAnyCallIsMendedByTheNextRun) {
    for (long at = 1; at <= moments_; ++at) {
        SCOPED_TRACE("call " + std::to_string(at));
        restore();
        EXPECT_EQ(faulty({"files", at, 0}, kDraw).exit_code, 1000 + SIGKILL);
        expect_nothing_broken();
        expect_mended();
    }
}

TEST_F(FaultTest, AnAllocationThatFailsIsOneLineAndNoHalfPicture) {
    const Words words = drawing({"in.png", "out.png"});
    const long all = calls("memory", words);
    ASSERT_GT(all, 1000);
    const std::string whole = file_bytes(folder_ / "out.png");
    std::vector<long> moments{1, 2, 3, 5, 8, 13, 21, 34, all - 2, all - 1, all};
    for (int k = 1; k <= 16; ++k) moments.push_back(all * k / 17);
    // Words, style and recipe: many small ones, before anything large. An odd stride meets all kinds.
    for (long at = 55; at < all / 10; at += 23) moments.push_back(at);
    for (const long at : moments) {
        SCOPED_TRACE("allocation " + std::to_string(at));
        fs::remove(folder_ / "out.png");
        const Outcome outcome = faulty({"memory", at, ENOMEM}, words);
        if (outcome.exit_code != 0) expect_error(outcome, 1, {"memory"});
        EXPECT_TRUE(file_bytes(folder_ / "out.png") == (outcome.exit_code == 0 ? whole : ""));
        EXPECT_EQ(folder_.names().size(), outcome.exit_code == 0 ? 2u : 1u);
    }
}

}  // namespace
}  // namespace dstylize::test
