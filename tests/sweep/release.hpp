/// A base that presses on an object, which goes away.
#pragma once

#include "draw.hpp"

namespace zwang::sweep {

/// The same run with its onset within a press and with the time at which every object leaves. A healthy run
/// of it says when the base presses; where it never does, the onset lies behind the end.
Drawn released(Drawn drawn);

}  // namespace zwang::sweep
