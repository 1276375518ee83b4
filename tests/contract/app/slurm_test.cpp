// The whole way through Slurm, on a cluster of our own, one of whose two nodes dies in the middle.
#include "contract/app/folder_fixture.h"
#include "support/slurm_cluster.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class Slurm : public FolderTest {
  protected:
    static constexpr int kPictures = 24, kShards = 4;
    // A shard takes seconds, so that a node can be caught in the middle of one.
    const Words style_{"--style", "vine", "--detail", "1600"};

    Slurm() {
        fs::remove_all(folder_ / "photos");
        fs::create_directories(folder_ / "photos/sea");
        for (int k = 0; k < kPictures; ++k)
            write_png(folder_ / "photos/sea" / (std::to_string(k) + ".png"), scene({200 + k, 160}));
    }
    Outcome run_styled(Words words) const {
        words.insert(words.end(), style_.begin(), style_.end());
        return run(words);
    }
    fs::path shard_file(const std::string& shard, const char* extension) const {
        return folder_ / "out/.dstylize/shards" / std::to_string(kShards) / (shard + extension);
    }
    /// The shard that the node is in the middle of; empty if it is in none.
    std::string half_done(const SlurmCluster& cluster, const std::string& node) const {
        std::string shard = cluster.said({"/usr/bin/squeue", "-h", "-r", "-t", "R", "-w", node, "-o", "%K"});
        shard = shard.substr(0, shard.find('\n'));
        const bool begun = !shard.empty() && fs::exists(shard_file(shard, ".jsonl"));
        return begun && !fs::exists(shard_file(shard, ".json")) ? shard : "";
    }
};

TEST_F(Slurm, DrawsEveryPictureOnceThoughANodeDies) {
    if (!SlurmCluster::is_installed())
        GTEST_SKIP() << "Slurm is not installed; ./dev test installs it (slurm-wlm, munge)";
    ASSERT_EQ(run_styled({"photos", "whole"}).exit_code, 0);
    SlurmCluster cluster;
    const Outcome outcome =
        run_styled({"sbatch", "photos", "out", "--nodes", "2", "--shards", std::to_string(kShards), "--submit"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string array = outcome.out.substr(outcome.out.find("array ") + 6, outcome.out.find(" of") - 16);

    std::string shard;
    SlurmCluster::wait_for([&] { return !(shard = half_done(cluster, "n1")).empty(); }, "a shard on the first node");
    cluster.kill_node("n1");
    ASSERT_FALSE(fs::exists(shard_file(shard, ".json"))) << "the shard was over before its node died";
    SlurmCluster::wait_for([&] { return fs::exists(folder_ / "out/report.json"); }, "the merged report");

    const std::string job = cluster.said({"/usr/bin/scontrol", "show", "job", array + "_" + shard});
    EXPECT_NE(job.find("Restarts=1"), std::string::npos) << job;
    EXPECT_EQ(states().size(), std::size_t(kPictures));
    std::size_t before = 0;
    for (const auto& [picture, state] : states()) {
        EXPECT_NE(state, "failed") << picture;
        before += state == "up to date";
    }
    EXPECT_GT(before, 0u) << "what the dead node had drawn was not drawn again";
    EXPECT_LT(before, std::size_t(kPictures / kShards));
    EXPECT_TRUE(results(folder_ / "out") == results(folder_ / "whole")) << "the bytes of one machine";
}

}  // namespace
}  // namespace dstylize::test
