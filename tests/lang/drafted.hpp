/// Robot files that are drafted from a URDF's text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang::test {

/// Of `urdf`, which is written as `name`. The test fails where there is no draft.
inline RobotDraft drafted(const Folder& folder, const std::string& urdf, const std::string& name = "r.urdf") {
  Diagnostics diagnostics;
  const auto draft = draft_robot(folder.write(name, urdf), name, diagnostics);
  EXPECT_TRUE(draft) << rendered(diagnostics);
  return draft.value_or(RobotDraft{});
}

}  // namespace zwang::lang::test
