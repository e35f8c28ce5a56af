#pragma once

#include <span>

#include "validation/experiment.h"

// Every family of cases, each in a file of its name. They are declared in the order in which they are printed.
namespace divot::validation {

Result<std::vector<Experiment>> paper(const Places& places);
Result<std::vector<Experiment>> crater_size(const Places& places);
Result<std::vector<Experiment>> crater_shape(const Places& places);
Result<std::vector<Experiment>> crater_shots(const Places& places);
Result<std::vector<Experiment>> crater_burst(const Places& places);
Result<std::vector<Experiment>> plate(const Places& places);
Result<std::vector<Experiment>> sphere(const Places& places);
Result<std::vector<Experiment>> wheel(const Places& places);
Result<std::vector<Experiment>> passes(const Places& places);
Result<std::vector<Experiment>> drop(const Places& places);
Result<std::vector<Experiment>> repose(const Places& places);
Result<std::vector<Experiment>> permanence(const Places& places);
Result<std::vector<Experiment>> resolution(const Places& places);
Result<std::vector<Experiment>> soil_balance(const Places& places);

std::span<const Family> families();

}  // namespace divot::validation
