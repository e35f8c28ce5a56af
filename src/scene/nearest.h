#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace divot::scene {

/// How many letters must be put in, left out, changed or swapped with their neighbour. [O(a b)]
int edit_distance(std::string_view a, std::string_view b);

/// The first of those among `known` nearest to `word`, or an empty text when there are none.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace divot::scene
