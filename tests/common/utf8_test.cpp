#include "common/words.h"
#include "testing.h"

namespace splotchcl {
namespace {

TEST(Printable, KeepsLettersOfAnyScript) {
  const std::string text = "M\u00fcnchen, \u03b1\u03b2, \u661f, \U0001f30c";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, HasNoCharacterThatATerminalObeys) {
  EXPECT_EQ(printable("a\x1b[2Jb"), "a?[2Jb");
  EXPECT_EQ(printable("a\nb\rc\x7f"), "a?b?c?");
  EXPECT_EQ(printable("\u009b2J"), "?2J");  // the same in one character
  EXPECT_EQ(printable("\u202egnp.exe"), "?gnp.exe");
}

TEST(Printable, HasAQuestionMarkForEachByteThatIsNoUtf8) {
  EXPECT_EQ(printable("caf\xe9"), "caf?");
  EXPECT_EQ(printable("\xff\xfe"), "??");
  EXPECT_EQ(printable("\xc0\x8a"), "??");            // a line's end in too many bytes
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // half a pair of UTF-16
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond all characters
  EXPECT_EQ(printable("\xe6\x98"), "??");            // cut
}

TEST(Utf8, IsRequiredOfWhatScenesName) {
  EXPECT_NO_THROW(require_utf8("M\u00fcnchen"));
  try {
    require_utf8("halo\xff");
    ADD_FAILURE() << "it was taken";
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()).find("\"halo?\" is not UTF-8"), 0U) << error.what();
  }
}

}  // namespace
}  // namespace splotchcl
