// The scripts for Slurm, run without it: as a node's shell would run them.
#include <fstream>

#include "contract/app/folder_fixture.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class SbatchTest : public FolderTest {
  protected:
    Outcome sbatch(Words words) const {
        words.insert(words.begin(), "sbatch");
        return draw(words);
    }
    /// Runs a script with the variables that Slurm sets for a task, from another folder than its own.
    int run_script(const std::string& script, int task, const std::string& restarts = "0") const {
        Process shell({"/usr/bin/env", "SLURM_ARRAY_TASK_ID=" + std::to_string(task), "SLURM_JOB_ID=5",
                       "SLURM_RESTART_COUNT=" + restarts, "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin",
                       "/bin/bash", script},
                      "/");
        return shell.wait();
    }
    /// A program in place of one of Slurm's, that writes its arguments to a file, a line for each.
    void pretend(const std::string& name, const std::string& says) const {
        fs::create_directories(folder_ / "bin");
        const fs::path program = folder_ / "bin" / name;
        std::ofstream(program) << "#!/bin/sh\nprintf '%s\\n' \"$@\" >>'" << (folder_ / (name + ".arguments")).string()
                               << "'\n"
                               << says;
        fs::permissions(program, fs::perms::owner_all);
    }
};

TEST_F(SbatchTest, ScriptsDrawAndMergeWhateverIsInTheNames) {
    const std::string out = "o'u t\n$(touch pwned)`touch pwned`;\"&\\", slurm = "/" + out + "/.dstylize/slurm/";
    expect_done(draw({"photos", "whole"}));
    const Outcome outcome = sbatch({"photos", out, "--nodes", "2", "--shards", "2", "--slurm=--partition=cpu"});
    expect_done(outcome);
    EXPECT_NE(outcome.out.find("--dependency=afterany:$array"), std::string::npos) << outcome.out;
    const std::string array = folder_.path().string() + slurm + "array.sbatch";
    EXPECT_NE(file_bytes(array).find("#SBATCH --array=1-2%2\n"), std::string::npos);
    EXPECT_NE(file_bytes(array).find("#SBATCH --partition=cpu\n"), std::string::npos);
    EXPECT_EQ(run_script(array, 1), 0);
    EXPECT_EQ(run_script(array, 2), 0);
    EXPECT_EQ(run_script(folder_.path().string() + slurm + "merge.sbatch", 0), 0);
    EXPECT_TRUE(results(folder_ / out) == results(folder_ / "whole"));
    EXPECT_EQ(states(out).size(), 3u);
    for (const fs::path& folder : {folder_.path(), fs::path("/")}) EXPECT_FALSE(fs::exists(folder / "pwned"));
}

TEST_F(SbatchTest, AShardThatFailsIsQueuedAgainAFewTimes) {
    pretend("scontrol", "");
    expect_done(sbatch({"photos", "out", "--nodes", "1", "--shards", "1"}));
    const std::string array = folder_ / "out/.dstylize/slurm/array.sbatch";
    write_file(folder_ / "photos/a.png", std::string_view("damaged"));
    EXPECT_EQ(run_script(array, 1), 0) << "the report names what is damaged";
    EXPECT_FALSE(fs::exists(folder_ / "scontrol.arguments"));
    fs::remove(folder_ / "out/.dstylize/manifest");
    fs::create_directory(folder_ / "out/.dstylize/manifest");
    EXPECT_EQ(run_script(array, 1), 3);
    EXPECT_EQ(file_bytes(folder_ / "scontrol.arguments"), "requeue\n5\n");
    EXPECT_EQ(run_script(array, 1, "3"), 3);
    EXPECT_EQ(file_bytes(folder_ / "scontrol.arguments"), "requeue\n5\n") << "not for ever";
}

TEST_F(SbatchTest, SubmitsByWordsAndNoShell) {
    pretend("sbatch", "echo '41;cluster'\n");
    const std::string out = "o ut$(touch pwned)";
    Process process({"/usr/bin/env", "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin", DSTYLIZE_PROGRAM,
                     "sbatch", "photos", out, "--nodes", "3", "--submit"},
                    folder_.path());
    EXPECT_EQ(process.wait(), 0) << process.err();
    EXPECT_NE(process.out().find("submitted array 41 of 3 shards"), std::string::npos) << process.out();
    const std::string slurm = (folder_ / out).string() + "/.dstylize/slurm/";
    EXPECT_EQ(
        file_bytes(folder_ / "sbatch.arguments"),
        "--parsable\n" + slurm + "array.sbatch\n--parsable\n--dependency=afterany:41\n" + slurm + "merge.sbatch\n");
    EXPECT_FALSE(fs::exists(folder_ / "pwned"));

    pretend("sbatch", "exit 1\n");
    Process refused({"/usr/bin/env", "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin", DSTYLIZE_PROGRAM,
                     "sbatch", "photos", out, "--nodes", "3", "--submit"},
                    folder_.path());
    EXPECT_EQ(refused.wait(), 1);
    EXPECT_EQ(refused.err(), "dstylize: sbatch: failed: see what it says above\n");
}

TEST_F(SbatchTest, ListsTheFolderAnewAndDrawsNothingTwice) {
    expect_done(sbatch({"photos", "out", "--nodes", "1", "--shards", "2"}));
    const std::string array = folder_ / "out/.dstylize/slurm/array.sbatch";
    EXPECT_EQ(run_script(array, 1), 0);
    const auto drawn_at = fs::last_write_time(folder_ / "out/a.png");
    write_png(folder_ / "photos/0.png", scene({50, 50}));  // moves all others into other shards
    expect_done(sbatch({"photos", "out", "--nodes", "1", "--shards", "2"}));
    EXPECT_EQ(run_script(array, 1), 0);
    EXPECT_EQ(run_script(array, 2), 0);
    expect_done({run({"merge-reports", "out"}).exit_code, "", ""});
    EXPECT_EQ(states()["0.png"], "done");
    EXPECT_EQ(states()["a.png"], "up to date");
    EXPECT_EQ(fs::last_write_time(folder_ / "out/a.png"), drawn_at);
}

TEST_F(SbatchTest, RefusesWrongUsageAndWritesNothingInADryRun) {
    expect_error(sbatch({"photos", "--nodes", "2"}), 2, {"sbatch", "IN OUT"});
    expect_error(sbatch({"photos", "out"}), 2, {"--nodes"});
    expect_error(sbatch({"in.png", "out", "--nodes", "2"}), 3, {"in.png", "no folder"});
    expect_error(sbatch({"photos", "out", "--nodes", "2", "--slurm=--x\n#SBATCH --y"}), 2, {"--slurm"});
    expect_error(sbatch({"photos", "out", "--nodes", "2", "--set", "width.widset=3"}), 2, {"widset"});
    const Outcome outcome = sbatch({"photos", "out", "--nodes", "2", "--dry-run"});
    expect_done(outcome);
    EXPECT_NE(outcome.out.find("#SBATCH --array=1-3%2"), std::string::npos) << outcome.out;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace dstylize::test
