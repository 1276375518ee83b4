#pragma once
#include <atomic>
#include <functional>

#include "ipc/descriptor.h"
#include "sandbox/confine.h"

namespace dstylize::codec {

enum class WorkerEnd { channel_closed = 0, retired = 10 };

/// Runs `work` in a forked and confined child until it ends because the channel closed. A child that retired is
/// followed by a new one at once; one that crashed too, after a CodecAnswer has said so if it was busy
/// (it sets the flag that it is given). When three in a row die without a task, no other will do better: it returns,
/// and who asks learns it from the channel. A fork takes milliseconds where loading takes a third of a second.
/// Libraries that start threads when they are loaded stay unusable in the child; those that we use start
/// theirs when they are first used. The child ends with this process, and as soon as the channel closes, however busy
/// or stuck it is.
void supervise(const ipc::Descriptor& channel,
               const std::function<WorkerEnd(std::atomic<bool>& busy, sandbox::Confinement held)>& work);

}  // namespace dstylize::codec
