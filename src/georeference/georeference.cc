// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeference.h"

#include <stdexcept>

namespace plumb {

const char* ToString(GeoreferenceSource source) {
  switch (source) {
    case GeoreferenceSource::kNone:
      return "none";
    case GeoreferenceSource::kGps:
      return "gps";
    case GeoreferenceSource::kTargets:
      return "targets";
  }
  throw std::logic_error("ToString: no such source");
}

const char* ToString(TargetState state) {
  switch (state) {
    case TargetState::kUnseen:
      return "unseen";
    case TargetState::kDouble:
      return "double";
    case TargetState::kUnsurveyed:
      return "unsurveyed";
    case TargetState::kWaiting:
      return "waiting";
    case TargetState::kGood:
      return "good";
    case TargetState::kWrong:
      return "wrong";
  }
  throw std::logic_error("ToString: no such state");
}

const char* ToString(Finding::Severity severity) {
  switch (severity) {
    case Finding::Severity::kNote:
      return "note";
    case Finding::Severity::kWarning:
      return "warning";
    case Finding::Severity::kError:
      return "error";
  }
  throw std::logic_error("ToString: no such severity");
}

}  // namespace plumb
