#include "robot/xml_scan.hpp"

#include "diagnostic/wordings.hpp"
#include "tree/prescan.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

/// Thrown when the text cannot be scanned on; its diagnostic is already written.
struct Abandoned {};

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ':' || c == '.';
}

class XmlScanner {
 public:
  XmlScanner(int source, std::string_view text, Diagnostics& diagnostics)
      : source_(source), text_(text), index_(text), diagnostics_(diagnostics) {}

  std::vector<XmlElement> scan() {
    while (at_ < text_.size()) {
      if (text_[at_] != '<') {
        scan_text();
      } else if (rest().starts_with("<!--")) {
        skip_past("<!--", "-->", "this comment does not end");
      } else if (rest().starts_with("<?")) {
        skip_past("<?", "?>", "this declaration does not end");
      } else if (rest().starts_with("<!")) {
        stop("a URDF has no DOCTYPE, entities or CDATA", at_, at_ + 2);
      } else if (rest().starts_with("</")) {
        scan_end_tag();
      } else {
        scan_start_tag();
      }
    }
    if (elements_.empty()) stop("there is no XML element in this file", 0, 0);
    if (!open_.empty()) {
      const XmlElement& element = elements_[static_cast<std::size_t>(open_.back())];
      diagnostics_.add(wording::not_xml(element.span, "<" + element.name + "> is never closed"));
      throw Abandoned{};
    }
    return std::move(elements_);
  }

 private:
  std::string_view rest() const { return text_.substr(at_); }

  Span span(std::size_t begin, std::size_t end) const {
    return {source_, index_.position(begin), index_.position(end)};
  }

  [[noreturn]] void stop(const std::string& reason, std::size_t begin, std::size_t end) {
    diagnostics_.add(wording::not_xml(span(begin, end), reason));
    throw Abandoned{};
  }

  /// The two marks share no character: `<!-->` opens a comment and does not close it.
  void skip_past(std::string_view open, std::string_view close, const char* complaint) {
    const std::size_t end = text_.find(close, at_ + open.size());
    if (end == std::string_view::npos) stop(complaint, at_, at_ + 2);
    at_ = end + close.size();
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  /// Text inside elements means nothing in a URDF, but for a simulator's; outside the root there must be
  /// none.
  void scan_text() {
    const char c = text_[at_];
    if (open_.empty() && !is_space(c)) stop("text outside the root element", at_, at_ + 1);
    if (!is_space(c)) elements_[static_cast<std::size_t>(open_.back())].text += c;
    ++at_;
  }

  std::string scan_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_part(text_[at_])) ++at_;
    if (at_ == begin) stop("a name is missing here", at_, at_ + 1);
    return std::string(text_.substr(begin, at_ - begin));
  }

  void scan_end_tag() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string name = scan_name();
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '>') stop("`>` is missing", at_, at_ + 1);
    ++at_;
    if (open_.empty()) stop("</" + name + "> closes nothing", begin, at_);
    const XmlElement& element = elements_[static_cast<std::size_t>(open_.back())];
    if (element.name != name) {
      stop("</" + name + "> stands where </" + element.name + "> is due, opened on line " +
               std::to_string(element.span.begin.line),
           begin, at_);
    }
    open_.pop_back();
  }

  void scan_start_tag() {
    const std::size_t begin = at_++;
    XmlElement element;
    element.name = scan_name();
    element.span = span(begin, at_);
    element.parent = open_.empty() ? -1 : open_.back();
    if (open_.empty() && !elements_.empty()) stop("a second root element", begin, at_);
    if (static_cast<int>(open_.size()) >= deepest_element) {
      diagnostics_.add(wording::xml_too_deep(element.span, deepest_element));
      throw Abandoned{};
    }
    bool closes_itself = false;
    while (true) {
      skip_spaces();
      if (at_ >= text_.size()) stop("<" + element.name + " does not end", begin, begin + 1);
      if (text_[at_] == '>') break;
      if (rest().starts_with("/>")) {
        closes_itself = true;
        ++at_;
        break;
      }
      scan_attribute(element);
    }
    ++at_;
    elements_.push_back(std::move(element));
    if (!closes_itself) open_.push_back(static_cast<int>(elements_.size()) - 1);
  }

  void scan_attribute(XmlElement& element) {
    const std::size_t begin = at_;
    XmlAttribute attribute;
    attribute.name = scan_name();
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '=') stop("`=` is missing behind this name", begin, at_);
    ++at_;
    skip_spaces();
    if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) {
      stop("the value of an attribute stands in quotes", begin, at_);
    }
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) stop("this quote does not close", at_, at_ + 1);
    attribute.value = std::string(text_.substr(at_ + 1, end - at_ - 1));
    attribute.span = span(at_ + 1, end);
    if (attribute.value.find('<') != std::string::npos) stop("`<` inside a value", at_, at_ + 1);
    if (element.find(attribute.name) != nullptr) {
      stop("attribute `" + attribute.name + "` is given twice", begin, at_);
    }
    if (element.attributes.size() >= most_attributes) {
      diagnostics_.add(wording::too_many_attributes(element.span, most_attributes));
      throw Abandoned{};
    }
    element.attributes.push_back(std::move(attribute));
    at_ = end + 1;
  }

  int source_;
  std::string_view text_;
  TextIndex index_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  std::vector<XmlElement> elements_;
  std::vector<int> open_;
};

}  // namespace

std::optional<std::vector<XmlElement>> scan_xml(int source, Diagnostics& diagnostics) {
  const std::string text = diagnostics.source(source).text;
  if (!prescan_characters(source, text, "E854", diagnostics)) return std::nullopt;
  try {
    return XmlScanner(source, text, diagnostics).scan();
  } catch (const Abandoned&) {
    return std::nullopt;
  }
}

}  // namespace zwang::lang
