#pragma once

#include "cli/options.h"

// One function for each command, in a file of that name. Each returns the exit status and has said what went wrong.
namespace divot::cli {

int run(const RunOptions& options);
int check(const CheckOptions& options);
int materials(const MaterialsOptions& options);
int render(const RenderOptions& options);
int view(const ViewOptions& options);
int bench(const BenchOptions& options);
int validate(const ValidateOptions& options);

}  // namespace divot::cli
