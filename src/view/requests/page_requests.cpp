#include "view/requests/page_requests.h"

#include <array>
#include <cstddef>
#include <utility>

#include "splotchcl/error.h"
#include "splotchcl_embedded/view_page.h"
#include "system/system.h"

namespace splotchcl::view {
namespace {

constexpr std::size_t token_bytes = 16;

// "name:port" without its port; "[::1]:80" is "[::1]".
std::string_view name_of(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const std::size_t bracket = host.rfind(']');
  if (colon == std::string_view::npos) return host;
  if (bracket != std::string_view::npos && bracket > colon) return host;
  return host.substr(0, colon);
}

bool is_any_address(std::string_view address) {
  return address == "0.0.0.0" || address == "::";
}

// An address in numbers, which no other page can make lead here.
bool is_number_of_address(std::string_view name) {
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') return true;
  return !name.empty() && name.find_first_not_of("0123456789.") == std::string_view::npos;
}

// "https://name:port" or the like, and nothing that would end a header or a policy.
bool is_origin(std::string_view text) {
  const std::string_view scheme = "http", end = "://";
  if (text.substr(0, scheme.size()) != scheme) return false;
  text.remove_prefix(scheme.size());
  if (!text.empty() && text.front() == 's') text.remove_prefix(1);
  if (text.substr(0, end.size()) != end) return false;
  text.remove_prefix(end.size());
  constexpr const char* letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]";
  return !text.empty() && text.find_first_not_of(letters) == std::string_view::npos;
}

// Takes as long wherever they differ, so that its time tells nothing.
bool are_equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(a[i] ^ b[i]) & 0xffu;
  return difference == 0;
}

}  // namespace

std::string make_token() {
  std::array<unsigned char, token_bytes> bytes;
  if (!of_system::fill_with_chance(bytes.data(), bytes.size())) {
    throw DataError("view: the system gave no random numbers, expected a token of 16 bytes");
  }
  constexpr const char* digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4];
    token += digits[byte & 15];
  }
  return token;
}

AccessRules::AccessRules(std::string token, std::string address, std::string framed_in)
    : token_(std::move(token)), address_(std::move(address)), framed_in_(std::move(framed_in)) {
  if (!framed_in_.empty() && !is_origin(framed_in_)) {
    throw UsageError("--frame-in: found " + framed_in_ +
                     ", expected a page's origin, such as http://localhost:8888");
  }
}

std::string_view AccessRules::check_request(const RequestSource& source) const {
  check_host(source.host);
  const bool is_own = source.origin == "http://" + std::string(source.host);
  if (!source.origin.empty() && !is_own && source.origin != framed_in_) {
    throw AccessDenied{"the Origin is another page's"};
  }
  return check_token(source.target);
}

std::string_view AccessRules::check_socket(const RequestSource& source) const {
  if (source.origin.empty()) throw AccessDenied{"a socket needs an Origin"};
  return check_request(source);
}

void AccessRules::check_host(std::string_view host) const {
  const std::string_view name = name_of(host);
  const bool is_known = name == "127.0.0.1" || name == "localhost" || name == "[::1]" ||
                        name == address_ || name == "[" + address_ + "]" ||
                        (is_any_address(address_) && is_number_of_address(name));
  if (name.empty() || !is_known) throw AccessDenied{"the Host is not this server's"};
}

std::string_view AccessRules::check_token(std::string_view target) const {
  const std::string_view path = target.substr(0, target.find('?'));
  const bool has_slash = !path.empty() && path.front() == '/';
  const std::string_view rest = has_slash ? path.substr(1) : std::string_view();
  const std::size_t end = rest.find('/');
  if (end == std::string_view::npos || !are_equal(rest.substr(0, end), token_)) {
    throw AccessDenied{
        "the address has no token, or a wrong one; take the one the program printed"};
  }
  return rest.substr(end + 1);
}

namespace {

std::string_view type_of(std::string_view name) {
  const std::string_view ending = name.substr(name.rfind('.') + 1);
  if (ending == "html") return "text/html; charset=utf-8";
  if (ending == "css") return "text/css; charset=utf-8";
  if (ending == "svg") return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

}  // namespace

std::optional<PageFile> find_page_file(std::string_view name) {
  if (name.empty()) name = "index.html";
  for (const embedded::TextFile& file : embedded::view_page()) {
    if (file.name == name) return PageFile{file.text, type_of(name)};
  }
  return std::nullopt;
}

}  // namespace splotchcl::view
