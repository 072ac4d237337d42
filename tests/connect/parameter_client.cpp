// Sets a parameter of /zwang, as `ros2 param set` does, and reads it back.
//
//   parameter_client DOMAIN NAME VALUE
//
// Prints `set` or the reason why not, then the value. Ends with 2 if a reply stays away.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "raw_client.hpp"

namespace {

using namespace zwang::connect;

/// rcl_interfaces/Parameter[] of one double.
Bytes wish(const std::string& parameter, double value) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(std::uint32_t{1}), write(parameter);
  write(std::uint8_t{3}), write(false), write(std::int64_t{0}), write(value), write(std::string());
  for (int list = 0; list < 5; ++list) write(std::uint32_t{0});
  return bytes;
}

int set_and_get(int domain, const std::string& parameter, double value) {
  test::Peer peer(domain);
  test::RawClient set(peer, "/zwang/set_parameters", "rcl_interfaces::srv::dds_::SetParameters_");
  test::RawClient get(peer, "/zwang/get_parameters", "rcl_interfaces::srv::dds_::GetParameters_");
  if (!set.wait_for_server() || !get.wait_for_server()) return 2;
  const auto told = set.call(wish(parameter, value));
  if (!told) return 2;
  std::uint32_t count = 0;
  bool is_set = false;
  std::string reason;
  CdrReader read_told(*told);
  read_told(count), read_told(is_set), read_told(reason);
  Bytes request;
  CdrWriter write(request);
  write(std::vector<std::string>{parameter});
  const auto kept = get.call(request);
  if (!kept) return 2;
  std::uint8_t type = 0;
  bool boolean = false;
  std::int64_t integer = 0;
  CdrReader read_kept(*kept);
  read_kept(count), read_kept(type), read_kept(boolean), read_kept(integer), read_kept(value);
  std::printf("%s, now %g\n", is_set ? "set" : reason.c_str(), value);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return argc == 4 ? set_and_get(std::atoi(argv[1]), argv[2], std::atof(argv[3])) : 2;
}
