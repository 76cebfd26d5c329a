#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace splotchcl::view {

// 32 random characters, which nobody guesses: they stand in the page's address. Throws DataError
// where the system has no random numbers.
std::string make_token();

// The parts of a request that say who asks, as they were sent; empty: not sent.
struct RequestSource {
  std::string_view target;  // "/TOKEN/app.js"
  std::string_view host;    // the Host header
  std::string_view origin;  // the Origin header
};

// Who may talk to the server: whoever knows its token, and was sent by no other page.
//   Host    the name must be 127.0.0.1, localhost, [::1] or the address that the server is bound
//   to:
//           a page that made its own name lead here is refused. Where the server is bound to all
//           addresses, any that is written in numbers will do. The port may be another, since it
//           is another behind a forwarded port.
//   Origin  where it is sent, it must be "http://" and the Host, to the letter, or that of the page
//           that may show this one in a frame: what forwards ports for it keeps it. A socket must
//           send it, as every browser does.
//   token   the first part of the target.
class AccessRules {
 public:
  // `address`: what the server is bound to. `framed_in`: the origin of the only other page that may
  // show this one in a frame, "http://localhost:8888"; empty: there is none. Throws UsageError for
  // what is no origin.
  AccessRules(std::string token, std::string address, std::string framed_in = "");

  // What is asked for below the token, "app.js"; empty for the page itself. Throws AccessDenied.
  std::string_view check_request(const RequestSource& source) const;
  // The same for a socket.
  std::string_view check_socket(const RequestSource& source) const;

  const std::string& framed_in() const { return framed_in_; }

 private:
  void check_host(std::string_view host) const;
  std::string_view check_token(std::string_view target) const;

  std::string token_;
  std::string address_;
  std::string framed_in_;
};

// Why a request is refused, for the one who sent it; says nothing of the token.
struct AccessDenied {
  std::string reason;
};

// A file of the page, which is embedded in the program.
struct PageFile {
  std::string_view text;
  std::string_view type;  // as HTTP names it
};

// By its name, "app.js"; the page itself has none. Nothing where there is no such file.
std::optional<PageFile> find_page_file(std::string_view name);

}  // namespace splotchcl::view
