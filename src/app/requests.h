#pragma once
#include <vector>

#include "app/options.h"
#include "pipeline/batch.h"
#include "pipeline/run.h"

namespace dstylize::app {

/// The run that the arguments of the main form ask for. Throws Error(bad_usage).
RunRequest draw_request(const Arguments& arguments);
/// The run of `write`: words or a mask, on a picture or on paper. Throws Error(bad_usage).
RunRequest write_request(const Arguments& arguments);
/// The same for what `draw` and `replay` share: outputs and how they are written.
void set_output_options(RunRequest& request, const Arguments& arguments);
/// Throws Error(bad_usage) when more than one thing of the run would go to standard output.
void check_standard_output(const RunRequest& request, const Arguments& arguments);

CodecOptions codec_options(const Arguments& arguments);

/// The batches that the arguments of the main form ask for when IN is a folder: one for each style. The results of
/// several lie in a folder each. Throws Error(bad_usage).
std::vector<BatchRequest> folder_requests(const Arguments& arguments);

}  // namespace dstylize::app
