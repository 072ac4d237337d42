/// What every diagnostic means: `zwang explain`. Its one source is docs/errors/CODE.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "zwang/export.hpp"

namespace zwang::lang {

/// The part of a file that an example shows. The rest of the file is then the smallest one that works.
enum class ExcerptOf {
  nothing,    ///< no example can be shown in a few lines
  whole,      ///< a whole task file
  task_file,  ///< keys of a task file
  task,       ///< keys of one task
  group,      ///< keys of one constraint group
  robot,      ///< keys of a robot file
  urdf,       ///< a link or a joint
  scene,      ///< keys of a scene file
};

/// The explanation of one code. All texts are Markdown.
struct Explanation {
  std::string_view code;   ///< as "E201"
  std::string_view title;  ///< a few words without a full stop
  std::string_view why;    ///< why zwang minds
  std::string_view fix;    ///< what to do about it
  ExcerptOf part = ExcerptOf::nothing;
  std::string_view example;  ///< shows it
  std::string_view instead;  ///< the same, mended
};

/// All explanations, sorted by their number.
ZWANG_EXPORT std::span<const Explanation> explanations();
/// By code, `E201` or `e201`; nullptr when there is no such code.
ZWANG_EXPORT const Explanation* find_explanation(std::string_view code);

/// For a terminal, without marks of Markdown around the examples.
ZWANG_EXPORT std::string explanation_text(const Explanation& explanation);
/// The page docs/errors/CODE.md, put together from its parts.
ZWANG_EXPORT std::string explanation_page(const Explanation& explanation);
/// The page docs/errors/README.md.
ZWANG_EXPORT std::string explanation_index();

}  // namespace zwang::lang
