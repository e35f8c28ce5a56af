#pragma once

#include <gdal_priv.h>

#include <string>

namespace divot::core {

/// Keeps GDAL quiet on this thread while it lives, and remembers what went wrong first. Drivers are registered.
class GdalSession {
 public:
  GdalSession();
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  bool failed() const { return failed_; }
  /// GDAL's words for the first failure, on one line; `otherwise` when it had none.
  std::string message(const std::string& otherwise) const { return message_.empty() ? otherwise : message_; }

 private:
  static void handle(CPLErr severity, CPLErrorNum, const char* text);

  bool failed_ = false;
  std::string message_;
};

}  // namespace divot::core
