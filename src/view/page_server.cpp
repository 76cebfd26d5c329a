#include "view/page_server.h"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <csignal>
#include <deque>
#include <list>
#include <optional>
#include <system_error>
#include <utility>

#include "splotchcl/error.h"
#include "view/answers.h"
#include "view/requests/page_requests.h"

namespace splotchcl::view {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = net::ip::tcp;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;
using FileResponse = http::response<http::file_body>;

constexpr std::chrono::seconds request_timeout{30};
// Of a connection that has not shown the token yet.
constexpr std::chrono::seconds stranger_timeout{5};
constexpr std::size_t most_strangers = 16;
// Of a connection that has had its last answer, until the other side closes it, too.
constexpr std::chrono::seconds closing_timeout{10};
constexpr int most_closing = 128;
constexpr std::uint32_t longest_request_header = 16 * 1024;
constexpr int most_connections = 64;
constexpr std::chrono::milliseconds pause_after_failure{100};
// A page that reads so little is given up.
constexpr std::size_t most_waiting_messages = 64;

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

RequestSource source_of(const Request& request) {
  return {view_of(request.target()), view_of(request[http::field::host]),
          view_of(request[http::field::origin])};
}

// "film/3" -> 3
std::optional<std::size_t> film_number(std::string_view name) {
  constexpr std::string_view start = "film/";
  if (name.substr(0, start.size()) != start) return std::nullopt;
  name.remove_prefix(start.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return number;
}

class HttpConnection;

// What all connections share; lives as long as the server.
struct Shared {
  AccessRules rules;
  DrawLoop& pages;
  int connections = 0;                     // that have shown the token
  std::list<HttpConnection*> strangers{};  // that have not; the oldest first
  int closing = 0;
};

// Counted from when it has shown the token to when it is closed.
class ConnectionCount {
 public:
  explicit ConnectionCount(Shared& shared) : shared_(&shared) { ++shared.connections; }
  ~ConnectionCount() { --shared_->connections; }
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;

 private:
  Shared* shared_;
};

// The socket of an open page.
class PageSocket : public std::enable_shared_from_this<PageSocket> {
 public:
  PageSocket(beast::tcp_stream stream, Shared& shared, std::shared_ptr<ConnectionCount> count)
      : socket_(std::move(stream)), shared_(shared), count_(std::move(count)) {}
  ~PageSocket() {
    if (page_ != 0) shared_.pages.close_page(page_);
  }

  void open(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(longest_message_bytes);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->opened();
    });
  }

 private:
  void opened() {
    const std::weak_ptr<PageSocket> weak = weak_from_this();
    const auto executor = socket_.get_executor();
    page_ = shared_.pages.open_page([weak, executor](OutgoingMessage message) {
      net::post(executor, [weak, message = std::move(message)]() mutable {
        if (const auto self = weak.lock()) self->send(std::move(message));
      });
    });
    read();
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->close();
      self->take();
      self->read();
    });
  }

  void take() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    try {
      shared_.pages.take(page_, parse_page_message(text));
    } catch (const std::exception& error) {
      send({false, message_error(error.what())});
    }
  }

  void close() {
    shared_.pages.close_page(page_);
    is_closed_ = true;
    beast::get_lowest_layer(socket_).close();
  }

  void send(OutgoingMessage message) {
    if (is_closed_) return;
    if (waiting_.size() >= most_waiting_messages) return close();
    waiting_.push_back(std::move(message));
    if (waiting_.size() == 1) write();
  }

  void write() {
    socket_.binary(waiting_.front().is_binary);
    socket_.async_write(net::buffer(waiting_.front().data),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->close();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) self->write();
                        });
  }

  websocket::stream<beast::tcp_stream> socket_;
  Shared& shared_;
  std::shared_ptr<ConnectionCount> count_;
  beast::flat_buffer buffer_;
  std::deque<OutgoingMessage> waiting_;  // the first is being written
  std::uint64_t page_ = 0;
  bool is_closed_ = false;
};

Response plain_response(http::status status, std::string text) {
  Response response{status, 11};
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.body() = std::move(text);
  return response;
}

// The page loads nothing from elsewhere, and stands in no other page but the one that it may.
template <class AnyResponse>
void set_policies(AnyResponse& response, std::string_view host, const std::string& framed_in) {
  const std::string sockets = "ws://" + std::string(host);
  response.set(http::field::server, "splotchcl");
  response.set(http::field::cache_control, "no-store");
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "connect-src 'self' " +
          sockets + "; base-uri 'none'; form-action 'none'; frame-ancestors " +
          (framed_in.empty() ? "'none'" : framed_in));
  response.set("Referrer-Policy", "no-referrer");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
}

// Closes a connection without a reset, with which the other side would lose the last answer if it
// has sent more meanwhile: nothing is sent any more, and what comes is dropped.
class ClosingConnection : public std::enable_shared_from_this<ClosingConnection> {
 public:
  ClosingConnection(Tcp::socket socket, Shared& shared)
      : socket_(std::move(socket)), timer_(socket_.get_executor()), shared_(shared) {
    ++shared_.closing;
  }
  ~ClosingConnection() { --shared_.closing; }
  ClosingConnection(const ClosingConnection&) = delete;
  ClosingConnection& operator=(const ClosingConnection&) = delete;

  void start() {
    beast::error_code ignored;
    socket_.shutdown(Tcp::socket::shutdown_send, ignored);
    timer_.expires_after(closing_timeout);
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      beast::error_code closing;
      if (!error) self->socket_.close(closing);
    });
    drop();
  }

 private:
  void drop() {
    socket_.async_read_some(net::buffer(dropped_),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) return self->drop();
                              self->timer_.cancel();
                            });
  }

  Tcp::socket socket_;
  net::steady_timer timer_;
  Shared& shared_;
  std::array<char, 4096> dropped_{};
};

// A connection that asks for files, until it becomes a socket.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)),
        shared_(shared),
        as_stranger_(shared.strangers.insert(shared.strangers.end(), this)) {}
  ~HttpConnection() { is_stranger_no_more(); }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_request_header);
    parser_->body_limit(std::uint64_t{0});
    stream_.expires_after(as_stranger_ ? stranger_timeout : request_timeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->serve(self->parser_->get());
                     });
  }

  // After its last answer, or for another one that comes.
  void give_up_place() {
    is_stranger_no_more();
    if (shared_.closing >= most_closing) return stream_.close();
    std::make_shared<ClosingConnection>(stream_.release_socket(), shared_)->start();
  }

 private:
  void is_stranger_no_more() {
    if (as_stranger_) shared_.strangers.erase(*as_stranger_);
    as_stranger_.reset();
  }

  // Whether there is a place for one that has shown the token.
  bool is_admitted() {
    if (count_) return true;
    if (shared_.connections >= most_connections) return false;
    is_stranger_no_more();
    count_ = std::make_shared<ConnectionCount>(shared_);
    stream_.expires_after(request_timeout);
    return true;
  }

  void serve(const Request& request) {
    const RequestSource source = source_of(request);
    try {
      const bool is_socket = websocket::is_upgrade(request);
      const std::string_view name =
          is_socket ? shared_.rules.check_socket(source) : shared_.rules.check_request(source);
      if (!is_admitted()) {
        return respond(plain_response(http::status::service_unavailable,
                                      "too many pages are open, expected at most 64\n"));
      }
      if (!is_socket && give_film(name)) return;
      if (!is_socket) return respond(answer(request, name));
      if (name != "live") {
        return respond(plain_response(http::status::not_found, "no such socket\n"));
      }
      std::make_shared<PageSocket>(std::move(stream_), shared_, count_)->open(request);
    } catch (const AccessDenied& denied) {
      respond(plain_response(http::status::forbidden, denied.reason + "\n"));
    }
  }

  static Response answer(const Request& request, std::string_view name) {
    const bool is_head = request.method() == http::verb::head;
    if (!is_head && request.method() != http::verb::get) {
      return plain_response(http::status::method_not_allowed, "only GET is understood\n");
    }
    const std::optional<PageFile> file = find_page_file(name);
    if (!file) return plain_response(http::status::not_found, "there is no such file\n");
    Response response{http::status::ok, 11};
    response.set(http::field::content_type, {file->type.data(), file->type.size()});
    if (is_head) {
      response.content_length(file->text.size());
    } else {
      response.body() = std::string(file->text);
    }
    return response;
  }

  // "film/3" as it lies on the disk. False: it is no such name.
  bool give_film(std::string_view name) {
    const std::optional<std::size_t> number = film_number(name);
    const auto path = number ? shared_.pages.film(*number) : std::nullopt;
    if (!path || parser_->get().method() != http::verb::get) return false;
    FileResponse response{http::status::ok, 11};
    beast::error_code error;
    response.body().open(path->c_str(), beast::file_mode::scan, error);
    if (error) return false;
    response.set(http::field::content_type, "application/octet-stream");
    stream_.expires_never();
    send(std::move(response));
    return true;
  }

  void respond(Response response) { send(std::move(response)); }

  template <class AnyResponse>
  void send(AnyResponse response) {
    const Request& request = parser_->get();
    set_policies(response, view_of(request[http::field::host]), shared_.rules.framed_in());
    response.keep_alive(count_ && request.keep_alive());
    if (request.method() != http::verb::head) response.prepare_payload();
    const auto kept = std::make_shared<AnyResponse>(std::move(response));
    http::async_write(stream_, *kept,
                      [self = shared_from_this(), kept](beast::error_code error, std::size_t) {
                        if (!error && kept->keep_alive()) return self->read();
                        self->give_up_place();
                      });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  std::optional<std::list<HttpConnection*>::iterator> as_stranger_;
  std::shared_ptr<ConnectionCount> count_;  // none of a stranger
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
};

Tcp::endpoint endpoint_of(const std::string& address, std::uint16_t port) {
  boost::system::error_code error;
  const auto parsed = net::ip::make_address(address, error);
  if (error) {
    throw UsageError("--bind: found '" + address +
                     "', expected the number of an address such as 127.0.0.1 or ::1");
  }
  return {parsed, port};
}

[[noreturn]] void refuse_to_listen(const std::string& address, std::uint16_t port,
                                   const boost::system::error_code& code) {
  if (code == boost::system::errc::address_not_available) {
    throw UsageError("--bind: found " + address +
                     ", expected an address of this machine, such as 127.0.0.1, or 0.0.0.0 for all "
                     "that it has");
  }
  throw DataError("--port: cannot listen on " + address + " port " + std::to_string(port) + ": " +
                  code.message() + "; another port, or 0 for any that is free");
}

}  // namespace

struct PageServer::State {
  State(const std::string& address, std::uint16_t port, AccessRules rules, DrawLoop& pages)
      : shared{std::move(rules), pages}, signals(context, SIGINT, SIGTERM), acceptor(context) {
    const Tcp::endpoint endpoint = endpoint_of(address, port);
    try {
      acceptor.open(endpoint.protocol());
      acceptor.set_option(net::socket_base::reuse_address(true));
      acceptor.bind(endpoint);
      acceptor.listen();
    } catch (const boost::system::system_error& error) {
      refuse_to_listen(address, port, error.code());
    }
    signals.async_wait([this](boost::system::error_code error, int) {
      if (!error) context.stop();
    });
    accept();
  }

  void accept() {
    acceptor.async_accept([this](boost::system::error_code error, Tcp::socket socket) {
      if (error == net::error::operation_aborted) return;
      if (error) return accept_later();
      // Whoever comes is heard, so that those who know no token keep nobody out.
      if (shared.strangers.size() >= most_strangers) shared.strangers.front()->give_up_place();
      boost::system::error_code ignored;
      socket.set_option(Tcp::no_delay(true), ignored);
      std::make_shared<HttpConnection>(std::move(socket), shared)->read();
      accept();
    });
  }

  // What fails for want of files would fail again at once, and again.
  void accept_later() {
    pause.expires_after(pause_after_failure);
    pause.async_wait([this](boost::system::error_code error) {
      if (!error) accept();
    });
  }

  Shared shared;  // before the context, whose connections refer to it
  net::io_context context{1};
  net::signal_set signals;
  Tcp::acceptor acceptor;
  net::steady_timer pause{context};
};

PageServer::PageServer(const std::string& address, std::uint16_t port, AccessRules rules,
                       DrawLoop& pages)
    : state_(std::make_unique<State>(address, port, std::move(rules), pages)) {}
PageServer::~PageServer() = default;

std::uint16_t PageServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void PageServer::run() {
  state_->context.run();
}

}  // namespace splotchcl::view
