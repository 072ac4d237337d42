/// Whose messages are obeyed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace zwang::connect {

/// The GUID of the writer that sent a message: twelve bytes of its process, four of its own.
using Sender = std::array<std::uint8_t, 16>;

/// Of several publishers of one thing the first is obeyed, until it has been silent for a while. Two robots
/// that both publish `/joint_states` would else be one robot that jumps.
class OnePublisher {
 public:
  static constexpr double silence = 1.0;  ///< [s] after which another one may take its place

  /// Whether the message counts. `arrival` [s] of any clock that does not go back.
  bool admits(const Sender& sender, double arrival);

 private:
  Sender sender_{};
  double last_ = 0.0;
  bool is_known_ = false;
};

/// An address of IPv4, its first byte first.
using Address = std::array<std::uint8_t, 4>;

/// Of the interfaces of this machine, as they are now; of the one with this name alone, where one is given.
std::vector<Address> own_addresses(const std::string& interface = {});

/// Whether a process that names these addresses as its own runs on this machine: all of them are `own`, or
/// begin with 127. All, because two machines may have an address of the same virtual network each.
bool is_of_this_machine(const std::vector<Address>& named, const std::vector<Address>& own);

}  // namespace zwang::connect
