#pragma once

namespace divot::cli {

/// From now on the first SIGINT or SIGTERM only makes interrupted() true, so that work can end in good order. The
/// second ends the program at once.
void catch_interrupts();

bool interrupted();

}  // namespace divot::cli
