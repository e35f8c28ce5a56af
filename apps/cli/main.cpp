#include <fmt/format.h>

#include <exception>

#include "cli/commands.h"

namespace divot::cli {
namespace {

int carry_out(const RunOptions& options) { return run(options); }
int carry_out(const CheckOptions& options) { return check(options); }
int carry_out(const MaterialsOptions& options) { return materials(options); }
int carry_out(const RenderOptions& options) { return render(options); }
int carry_out(const ViewOptions& options) { return view(options); }
int carry_out(const BenchOptions& options) { return bench(options); }
int carry_out(const ValidateOptions& options) { return validate(options); }

}  // namespace
}  // namespace divot::cli

int main(int argc, char** argv) try {
  const auto command = divot::cli::parse(argc, argv);
  if (!command) return command.error();
  return std::visit([](const auto& options) { return divot::cli::carry_out(options); }, *command);
} catch (const std::exception& error) {
  // Out of memory, for one.
  fmt::print(stderr, "divot: {}\n", error.what());
  return divot::cli::kFailed;
}
