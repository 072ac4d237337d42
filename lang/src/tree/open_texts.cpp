#include "zwang/lang/open_texts.hpp"

#include <utility>

namespace zwang::lang {

namespace {

thread_local const OpenTexts* innermost = nullptr;

}  // namespace

std::filesystem::path canonical_name(const std::filesystem::path& file) {
  std::error_code error;
  // Absolute first: of a path that begins with something that is not there the library gives back a relative
  // one.
  const std::filesystem::path absolute = std::filesystem::absolute(file, error);
  if (error) return file;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

void OpenTexts::put(const std::filesystem::path& file, std::string text) {
  texts_[canonical_name(file)] = std::move(text);
}

void OpenTexts::remove(const std::filesystem::path& file) {
  texts_.erase(canonical_name(file));
}

const std::string* OpenTexts::find(const std::filesystem::path& file) const {
  if (texts_.empty()) return nullptr;
  const auto found = texts_.find(canonical_name(file));
  return found == texts_.end() ? nullptr : &found->second;
}

ReadsOpenTexts::ReadsOpenTexts(const OpenTexts& texts) : outer_(std::exchange(innermost, &texts)) {}

ReadsOpenTexts::~ReadsOpenTexts() {
  innermost = outer_;
}

OpenTexts open_texts() {
  return innermost == nullptr ? OpenTexts() : *innermost;
}

const std::string* open_text_of(const std::filesystem::path& file) {
  return innermost == nullptr ? nullptr : innermost->find(file);
}

}  // namespace zwang::lang
