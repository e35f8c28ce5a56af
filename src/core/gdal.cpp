#include "core/gdal.h"

#include <cpl_error.h>

#include <algorithm>

namespace divot::core {

// Handlers are per thread, so that a program that uses GDAL elsewhere keeps its own. The registry is one per process.
GdalSession::GdalSession() {
  CPLPushErrorHandlerEx(handle, this);
  GDALAllRegister();
  // What registering complained about (a plugin that is missing) is not about this file.
  failed_ = false;
  message_.clear();
  CPLErrorReset();
}

GdalSession::~GdalSession() { CPLPopErrorHandler(); }

void GdalSession::handle(CPLErr severity, CPLErrorNum, const char* text) {
  auto* session = static_cast<GdalSession*>(CPLGetErrorHandlerUserData());
  if (severity < CE_Failure || session->failed_) return;
  session->failed_ = true;
  session->message_ = text;
  std::replace(session->message_.begin(), session->message_.end(), '\n', ' ');
}

}  // namespace divot::core
