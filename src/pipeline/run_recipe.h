#pragma once
#include <string>

#include "pipeline/recipe.h"
#include "pipeline/run.h"

namespace dstylize {

/// The recipe of a request but for the files that it reads: their marks are known when they are read.
Recipe recipe_of(const RunRequest& request, std::string style_toml);

}  // namespace dstylize
