// A decoder that a hostile picture has taken over shall find nothing to do: Linux' seccomp takes away the system calls
// that decoding does not need, Landlock the files. Both last until the process ends.
#include "sandbox/confine.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <linux/sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace dstylize::sandbox {
namespace {

/// Address space in use, in bytes.
std::uint64_t address_space_bytes() {
    unsigned long long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * std::uint64_t(sysconf(_SC_PAGESIZE));
}

void lower(__rlimit_resource resource, rlim_t most) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_max <= most) most = limit.rlim_max;
    limit = {most, most};
    setrlimit(resource, &limit);
}

/// Harmless whatever their arguments are.
constexpr int kFree[] = {
    // memory
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(memfd_create), SCMP_SYS(ftruncate),
    SCMP_SYS(fallocate), SCMP_SYS(membarrier),
    // what is open already
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(pwrite64),
    SCMP_SYS(lseek), SCMP_SYS(_llseek), SCMP_SYS(close), SCMP_SYS(dup), SCMP_SYS(fstat), SCMP_SYS(fstat64),
    SCMP_SYS(fsync), SCMP_SYS(sendmsg), SCMP_SYS(recvmsg), SCMP_SYS(poll), SCMP_SYS(ppoll),
    // a way from this process to itself, by which UndefinedBehaviorSanitizer asks what memory is readable
    SCMP_SYS(pipe), SCMP_SYS(pipe2),
    // looking at names
    SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(newfstatat), SCMP_SYS(statx), SCMP_SYS(access), SCMP_SYS(faccessat),
    SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getcwd),
    // threads
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield), SCMP_SYS(sched_getaffinity),
    SCMP_SYS(gettid), SCMP_SYS(getpid), SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack), SCMP_SYS(restart_syscall),
    // the machine and the time
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(getrandom), SCMP_SYS(getrusage), SCMP_SYS(getrlimit), SCMP_SYS(sysinfo),
    SCMP_SYS(uname), SCMP_SYS(getcpu)};

/// The rules on calls whose arguments matter.
bool add_rules_with_arguments(scmp_filter_ctx filter) {
    constexpr scmp_datum_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | (O_TMPFILE & ~O_DIRECTORY);
    const auto own = scmp_datum_t(getpid());
    const auto allow = [&](int call, const scmp_arg_cmp& condition) {
        return seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, condition) == 0;
    };
    // Not F_SETOWN and F_SETSIG, by which a descriptor would send any signal to anybody.
    for (const int command : {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_ADD_SEALS, F_GET_SEALS})
        for (const int call : {SCMP_SYS(fcntl), SCMP_SYS(fcntl64)})
            if (!allow(call, SCMP_A1(SCMP_CMP_EQ, scmp_datum_t(command)))) return false;
    return allow(SCMP_SYS(open), SCMP_A1(SCMP_CMP_MASKED_EQ, kWriting, 0)) &&
           allow(SCMP_SYS(openat), SCMP_A2(SCMP_CMP_MASKED_EQ, kWriting, 0)) &&
           allow(SCMP_SYS(mmap), SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)) &&
           allow(SCMP_SYS(mprotect), SCMP_A1(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)) &&
           // Threads, not processes. The C library tries clone3 first, whose flags no filter sees.
           allow(SCMP_SYS(clone), SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD)) &&
           seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) == 0 &&
           allow(SCMP_SYS(prlimit64), SCMP_A2(SCMP_CMP_EQ, 0)) &&  // asks, sets nothing
           allow(SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, own));     // abort()
}

bool filter_system_calls() {
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (!filter) return false;
    bool good = seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1) == 0;
    for (const int call : kFree) good = good && seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0;
    good = good && add_rules_with_arguments(filter) && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return good;
}

/// Landlock reaches this thread and those that it starts.
bool close_files() {
    const auto abi = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (abi < 1) return false;
    // All rights on files of the first version lie below this one; that to truncate came with the third.
    constexpr std::uint64_t kFirst = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1, kTruncate = 1u << 14;
    landlock_ruleset_attr rules{};
    rules.handled_access_fs = abi >= 3 ? kFirst | kTruncate : kFirst;
    const auto ruleset = int(syscall(SYS_landlock_create_ruleset, &rules, sizeof(rules), 0));
    if (ruleset < 0) return false;
    const bool good = syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
    close(ruleset);
    return good;
}

}  // namespace

void limit_resources(std::uint64_t max_memory_bytes) {
    constexpr rlim_t kDescriptors = 64;
    // Threads reserve address space for stacks and heaps that they hardly use.
    constexpr std::uint64_t kThreads = 512u << 20;
    lower(RLIMIT_CORE, 0);
    lower(RLIMIT_NOFILE, kDescriptors);
    prctl(PR_SET_DUMPABLE, 0);
    const std::uint64_t fixed = address_space_bytes() + kThreads;
    if (max_memory_bytes > RLIM_INFINITY - fixed) return;
    lower(RLIMIT_AS, fixed + max_memory_bytes);
    lower(RLIMIT_FSIZE, max_memory_bytes);
    std::signal(SIGXFSZ, SIG_IGN);  // then it is an error, not the end
}

Confinement confine() noexcept {
    Confinement held;
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return held;
    held.files = close_files();
    held.system_calls = filter_system_calls();
    return held;
}

}  // namespace dstylize::sandbox
