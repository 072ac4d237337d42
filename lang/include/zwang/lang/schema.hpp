/// JSON Schemas (draft 7) of zwang's files, for editors: completion, hover texts, the first check while
/// typing.
#pragma once

#include <string>

#include "zwang/export.hpp"
#include "zwang/lang/file_kind.hpp"

namespace zwang::lang {

/// What a schema can say of a file: keys, shapes, and whether a text looks like a quantity. Names, dimensions
/// and everything else is for `load` to judge.
ZWANG_EXPORT std::string json_schema(FileKind kind);

}  // namespace zwang::lang
