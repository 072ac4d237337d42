/// The schema of a kind of file at one place.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/file_kind.hpp"

namespace zwang::lang {

struct SchemaKey {
  std::string name;
  std::string about;
};

/// Keys and words for a place. All choices count that fit the keys so far.
struct SchemaPlace {
  std::vector<SchemaKey> keys;
  std::vector<std::string> words;  ///< that a value may be
  std::string about;               ///< of the value
};
/// `keys`: as TextPlace::keys.
SchemaPlace schema_place(FileKind kind, const std::vector<std::string>& keys);

}  // namespace zwang::lang
