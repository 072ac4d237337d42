/// Units for the value at a place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/names.hpp"

namespace zwang::lang {

/// The text and the names tell the dimension of a value where its keys do not.
struct UnitSources {
  FileKind kind = FileKind::task;
  std::string_view
      text;  ///< of the file: a use of a parameter, or of a template's argument, tells its dimension
  const std::vector<NamePlace>& given;
};

/// Units of what the key measures, the usual one first; all units where that is not known. `keys`: as
/// TextPlace::keys.
std::vector<std::string> units_that_fit(const std::vector<std::string>& keys, const UnitSources& sources);
/// Behind the number at the end of a condition: those of what it is compared with.
std::vector<std::string> units_in_condition(std::string_view condition, const UnitSources& sources);

}  // namespace zwang::lang
