#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "ipc/channel.h"
#include "ipc/codec_protocol.h"

namespace dstylize {

/// The running program dstylize-codec. Its end of the channel closing is what ends it, so it never
/// outlives this process; it gets no terminal, no signals of the terminal and no standard error.
class CodecProcess {
  public:
    /// Returns while the program still loads. Throws Error(failed).
    CodecProcess(const std::filesystem::path& program, std::uint64_t max_memory_bytes);
    CodecProcess(const CodecProcess&) = delete;
    CodecProcess& operator=(const CodecProcess&) = delete;
    /// Ends it if it still runs, and reaps it.
    ~CodecProcess();

    enum class Outcome {
        answered,
        died,  ///< while it had the request
        timed_out,
        was_dead,  ///< the request was not sent
    };

    /// Sends one request with the memory `payload` and waits. Whatever but `answered` leaves a process
    /// that is of no more use. Throws Error(failed) when the program never came up or is another version.
    Outcome ask(const ipc::CodecRequest& request, const ipc::Descriptor& payload, ipc::CodecAnswer& answer,
                ipc::Descriptor& answer_payload, double timeout_s);

    /// How it died, for people: "signal 11 (Segmentation fault)". Ends it if it still runs.
    std::string cause_of_death();

  private:
    void await_greeting();
    void end();
    bool reaped(int wait_options);

    std::filesystem::path program_;
    ipc::Descriptor channel_;
    pid_t pid_ = -1;
    int wait_status_ = 0;
    bool greeted_ = false;
};

/// The path of dstylize-codec; `asked` wins when it is not empty. Throws Error(failed) when none exists.
std::filesystem::path codec_program(const std::filesystem::path& asked);

}  // namespace dstylize
