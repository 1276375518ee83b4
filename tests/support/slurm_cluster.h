#pragma once
#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/process.h"

namespace dstylize::test {

/// A Slurm cluster of two nodes, n1 and n2, on this machine's loopback: with a munge key, ports and state of its own,
/// all gone at the end. While it lives, SLURM_CONF names it.
class SlurmCluster {
  public:
    static bool is_installed() {
        for (const char* program : {"/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/sbin/munged", "/usr/bin/sbatch"})
            if (::access(program, X_OK) != 0) return false;
        return true;
    }

    SlurmCluster() {
        namespace fs = std::filesystem;
        for (const char* folder : {"state", "munge"}) fs::create_directory(folder_ / folder);
        fs::permissions(folder_ / "munge", fs::perms::owner_all);
        write_file(folder_ / "munge/key", std::string_view(file_start("/dev/urandom", 1024)));
        fs::permissions(folder_ / "munge/key", fs::perms::owner_read);
        const std::string munge = (folder_ / "munge").string();
        munged_ = start({"/usr/sbin/munged", "--foreground", "--force", "--key-file", munge + "/key", "--socket",
                         munge + "/socket", "--pid-file", munge + "/pid", "--log-file", munge + "/log", "--seed-file",
                         munge + "/seed"});
        wait_for([&] { return fs::exists(munge + "/socket"); }, "munged");
        write_file(folder_ / "slurm.conf", std::string_view(configuration()));
        ::setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
        controller_ = start({"/usr/sbin/slurmctld", "-D", "-c"});
        for (const char* node : {"n1", "n2"}) nodes_[node] = start({"/usr/sbin/slurmd", "-D", "-N", node});
        wait_for([&] { return said({"/usr/bin/sinfo", "-h", "-t", "idle", "-o", "%D"}) == "2\n"; }, "the two nodes");
    }
    ~SlurmCluster() {
        for (const char* node : {"n1", "n2"}) kill_jobs_of(node);
        ::unsetenv("SLURM_CONF");
    }
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    /// What one of Slurm's programs says.
    std::string said(std::vector<std::string> command) const {
        Process process(std::move(command), folder_.path());
        process.wait();
        return process.out();
    }

    /// As a power cut does: the node's daemon, its keepers of jobs, and the jobs.
    void kill_node(const std::string& node) {
        nodes_.at(node).reset();
        kill_jobs_of(node);
    }

    template <class Condition>
    static void wait_for(Condition condition, const std::string& what) {
        for (int n = 0; n < 2000; ++n) {
            if (condition()) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        throw std::runtime_error("waited in vain for " + what);
    }

  private:
    static std::string file_start(const char* path, std::size_t bytes) {
        std::string out(bytes, '\0');
        std::ifstream(path, std::ios::binary).read(out.data(), std::streamsize(bytes));
        return out;
    }

    std::unique_ptr<Process> start(std::vector<std::string> command) const {
        return std::make_unique<Process>(std::move(command), folder_.path());
    }

    /// Ports that nobody has at the moment.
    static std::vector<int> free_ports(std::size_t count) {
        std::vector<int> sockets, ports;
        for (std::size_t k = 0; k < count; ++k) {
            sockets.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
            sockaddr_in address{};
            address.sin_family = AF_INET;
            address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            socklen_t size = sizeof address;
            auto* general = reinterpret_cast<sockaddr*>(&address);
            if (::bind(sockets.back(), general, size) != 0 || ::getsockname(sockets.back(), general, &size) != 0)
                throw std::runtime_error("no free port");
            ports.push_back(ntohs(address.sin_port));
        }
        for (const int socket : sockets) ::close(socket);
        return ports;
    }

    std::string configuration() const {
        const std::vector<int> ports = free_ports(3);
        std::string host(256, '\0');
        ::gethostname(host.data(), host.size() - 1);
        host = host.substr(0, std::min(host.find('.'), host.find('\0')));
        const std::string dir = folder_.path(), user = std::to_string(::geteuid());
        std::ostringstream out;
        out << "ClusterName=loopback\nSlurmctldHost=" << host << "(127.0.0.1)\nSlurmUser=" << user
            << "\nSlurmdUser=" << user << "\nAuthType=auth/munge\nAuthInfo=socket=" << dir
            << "/munge/socket,cred_expire=5\nCredType=cred/munge\nSlurmctldPort=" << ports[0]
            << "\nStateSaveLocation=" << dir << "/state\nSlurmdSpoolDir=" << dir << "/spool%n\nSlurmctldPidFile=" << dir
            << "/slurmctld.pid\nSlurmdPidFile=" << dir << "/slurmd-%n.pid\nSlurmctldLogFile=" << dir
            << "/slurmctld.log\nSlurmdLogFile=" << dir
            << "/slurmd-%n.log\nProctrackType=proctrack/pgid\nTaskPlugin=task/none\n"
               "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\nSchedulerType=sched/backfill\n"
               "SchedulerParameters=sched_interval=1,bf_interval=1\nAccountingStorageType=accounting_storage/none\n"
               "JobAcctGatherType=jobacct_gather/none\nMpiDefault=none\nReturnToService=2\nSlurmdTimeout=5\n"
               "SlurmctldTimeout=10\nKillWait=2\nMinJobAge=300\nJobRequeue=1\n";
        for (int k = 1; k <= 2; ++k)
            out << "NodeName=n" << k << " NodeHostname=" << host << " NodeAddr=127.0.0.1 Port=" << ports[std::size_t(k)]
                << " CPUs=1 RealMemory=512 State=UNKNOWN\n";
        out << "PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP OverSubscribe=NO\n";
        return out.str();
    }

    /// The processes of jobs know their node and our configuration by their environment; a job's first is a child of
    /// its keeper.
    void kill_jobs_of(const std::string& node) const {
        const std::string ours = std::string("SLURM_CONF=") + (folder_ / "slurm.conf").string() + '\0';
        const std::string there = "SLURMD_NODENAME=" + node + '\0';
        std::set<pid_t> jobs, keepers;
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            const std::string name = entry.path().filename();
            if (name.find_first_not_of("0123456789") != std::string::npos) continue;
            const std::string environment = file_bytes(entry.path() / "environ") + '\0';
            if (environment.find(ours) == std::string::npos || environment.find(there) == std::string::npos) continue;
            jobs.insert(std::stoi(name));
            const std::string status = file_bytes(entry.path() / "status");
            if (const std::size_t at = status.find("\nPPid:"); at != std::string::npos) {
                const pid_t parent = std::stoi(status.substr(at + 6));
                if (file_bytes(std::filesystem::path("/proc") / std::to_string(parent) / "comm") == "slurmstepd\n")
                    keepers.insert(parent);
            }
        }
        for (const pid_t id : keepers) ::kill(id, SIGKILL);
        for (const pid_t id : jobs) ::kill(id, SIGKILL);
    }

    TempFolder folder_;
    std::unique_ptr<Process> munged_, controller_;
    std::map<std::string, std::unique_ptr<Process>> nodes_;
};

}  // namespace dstylize::test
