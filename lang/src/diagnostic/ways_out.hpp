/// Keys of other programs for which zwang has no key, but another way to say it.
#pragma once

#include <string>
#include <string_view>

namespace zwang::lang {

/// How it is said here. `what` names the mapping in which the key stands, as messages do: "axis `contact.x`".
/// Empty: nothing is known of it.
std::string way_out(std::string_view what, std::string_view key);

}  // namespace zwang::lang
