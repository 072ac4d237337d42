#pragma once

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

inline const char* word_of(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

}  // namespace zwang::lang
