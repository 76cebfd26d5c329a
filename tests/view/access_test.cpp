// Who may talk to the server of the live view.
#include <gtest/gtest.h>

#include <set>

#include "view/requests/page_requests.h"

namespace splotchcl::view {
namespace {

const std::string token = "0123456789abcdef0123456789abcdef";

bool lets_in(const RequestSource& source, const std::string& address = "127.0.0.1") {
  try {
    AccessRules(token, address).check_request(source);
    return true;
  } catch (const AccessDenied&) {
    return false;
  }
}

bool lets_socket_in(const RequestSource& source) {
  try {
    AccessRules(token, "127.0.0.1").check_socket(source);
    return true;
  } catch (const AccessDenied&) {
    return false;
  }
}

const std::string page = "/" + token + "/";

TEST(Token, HasThirtyTwoDigitsAndIsAnotherEachTime) {
  std::set<std::string> tokens;
  for (int i = 0; i < 20; ++i)
    tokens.insert(make_token());
  EXPECT_EQ(tokens.size(), 20u);
  EXPECT_EQ(tokens.begin()->size(), 32u);
  EXPECT_EQ(tokens.begin()->find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Access, IsForTheTokenAtTheStartOfThePath) {
  const AccessRules rules(token, "127.0.0.1");
  EXPECT_EQ(rules.check_request({page, "127.0.0.1:80", ""}), "");
  EXPECT_EQ(rules.check_request({page + "app.js?x=1", "127.0.0.1:80", ""}), "app.js");
}

TEST(Access, IsNotForOtherTokens) {
  for (const std::string& target :
       {std::string("/"), std::string(), std::string("/app.js"), "/" + token, "//" + token + "/",
        "/" + token + "0/", "/" + token.substr(1) + "/", "/x?/" + token + "/",
        "/" + std::string(32, '0') + "/"})
    EXPECT_FALSE(lets_in({target, "127.0.0.1:80", ""})) << target;
}

TEST(Access, IsForTheNamesOfThisMachineAtAnyPort) {
  for (const char* const host :
       {"127.0.0.1:8080", "localhost:8080", "127.0.0.1", "[::1]:8080", "localhost"})
    EXPECT_TRUE(lets_in({page, host, ""})) << host;
}

TEST(Access, IsNotForOtherNamesThatLeadHere) {
  for (const char* const host : {"evil.example", "evil.example:8080", "127.0.0.1.evil.example",
                                 "localhost.evil.example:80", "", ":80", "127.0.0.2", "LOCALHOST"})
    EXPECT_FALSE(lets_in({page, host, ""})) << host;
}

TEST(Access, IsForTheAddressThatIsListenedOn) {
  EXPECT_TRUE(lets_in({page, "192.0.2.7:80", ""}, "192.0.2.7"));
  EXPECT_TRUE(lets_in({page, "[2001:db8::7]:80", ""}, "2001:db8::7"));
  EXPECT_FALSE(lets_in({page, "192.0.2.8:80", ""}, "192.0.2.7"));
}

TEST(Access, IsForEveryAddressInNumbersWhereAllAreListenedOn) {
  EXPECT_TRUE(lets_in({page, "192.0.2.7:80", ""}, "0.0.0.0"));
  EXPECT_TRUE(lets_in({page, "[2001:db8::7]:80", ""}, "::"));
  EXPECT_FALSE(lets_in({page, "evil.example:80", ""}, "0.0.0.0"));
  EXPECT_FALSE(lets_in({page, ":80", ""}, "0.0.0.0"));
}

TEST(Access, IsForThePagesOwnOriginOnly) {
  EXPECT_TRUE(lets_in({page, "127.0.0.1:80", "http://127.0.0.1:80"}));
  for (const char* const origin :
       {"http://evil.example", "http://127.0.0.1:81", "http://localhost:80", "https://127.0.0.1:80",
        "http://127.0.0.1:80/", "null"})
    EXPECT_FALSE(lets_in({page, "127.0.0.1:80", origin})) << origin;
}

TEST(Access, OfSocketsNeedsAnOrigin) {
  EXPECT_TRUE(lets_socket_in({page + "live", "127.0.0.1:80", "http://127.0.0.1:80"}));
  EXPECT_FALSE(lets_socket_in({page + "live", "127.0.0.1:80", ""}));
}

}  // namespace
}  // namespace splotchcl::view
