#include "log/compression.hpp"

#include <zlib.h>
#include <zstd.h>

namespace zwang::runtime {

namespace {

constexpr int level = 3;  // zstd's own default

}  // namespace

std::optional<std::string> compress(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) return std::nullopt;
  packed.resize(size);
  return packed;
}

bool decompress(std::string_view bytes, std::size_t size, std::string& whole) {
  whole.resize(size);
  return ZSTD_decompress(whole.data(), size, bytes.data(), bytes.size()) == size;
}

std::optional<std::string> deflate(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string deflated(size, '\0');
  const auto* from = reinterpret_cast<const Bytef*>(bytes.data());
  auto* into = reinterpret_cast<Bytef*>(deflated.data());
  if (compress2(into, &size, from, bytes.size(), Z_BEST_COMPRESSION) != Z_OK) return std::nullopt;
  deflated.resize(size);
  return deflated;
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t crc) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(::crc32_z(crc, data, bytes.size()));
}

}  // namespace zwang::runtime
