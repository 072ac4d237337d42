#include "log/compression.hpp"

#include <zlib.h>
#include <zstd.h>

namespace zwang::runtime {

namespace {

// Blocks are packed already. Level -5 writes 21 % less, and takes 2.6 times as long (the hospital's chunks).
constexpr int level = -30;

}  // namespace

struct Compressor::State {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  std::string packed;
};

Compressor::Compressor() : state_(std::make_unique<State>()) {}

Compressor::~Compressor() {
  ZSTD_freeCCtx(state_->context);
}

std::optional<std::string_view> Compressor::compress(std::string_view bytes) {
  std::string& packed = state_->packed;
  const std::size_t most = ZSTD_compressBound(bytes.size());
  if (packed.size() < most) packed.resize(most);
  if (state_->context == nullptr) return std::nullopt;
  const std::size_t size =
      ZSTD_compressCCtx(state_->context, packed.data(), packed.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) return std::nullopt;
  return std::string_view(packed).substr(0, size);
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
