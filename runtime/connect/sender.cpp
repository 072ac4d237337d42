#include "sender.hpp"

#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstring>

namespace zwang::connect {

bool OnePublisher::admits(const Sender& sender, double arrival) {
  const bool is_free = !is_known_ || arrival - last_ > silence;
  if (!is_free && sender != sender_) return false;
  sender_ = sender;
  last_ = arrival;
  is_known_ = true;
  return true;
}

std::vector<Address> own_addresses(const std::string& interface) {
  std::vector<Address> addresses;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return addresses;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if (!interface.empty() && interface != one->ifa_name) continue;
    sockaddr_in address{};
    std::memcpy(&address, one->ifa_addr, sizeof address);
    Address bytes{};
    std::memcpy(bytes.data(), &address.sin_addr, bytes.size());  // in the order of the network
    addresses.push_back(bytes);
  }
  freeifaddrs(first);
  return addresses;
}

bool is_of_this_machine(const std::vector<Address>& named, const std::vector<Address>& own) {
  constexpr std::uint8_t loopback = 127;
  return !named.empty() && std::all_of(named.begin(), named.end(), [&](const Address& address) {
    return address[0] == loopback || std::find(own.begin(), own.end(), address) != own.end();
  });
}

}  // namespace zwang::connect
