#include "fuzz/fuzz.h"

int splotchcl::fuzz::fuzz_text(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  fuzz::write_scratch(data, size);
  fuzz::read_as(text_table_format());
  fuzz::read_as(text_table_format(), {{"x", "y", "z"}});
  fuzz::read_as(text_table_format(), {{"id", "z", "-", "x", "y"}});
  fuzz::read_as(text_table_format(), {{"x=1", "y=2", "z=c"}, 2});
  fuzz::read_as(text_table_format(), {}, "step=1");
  try {
    text_table_format().groups_in(fuzz::scratch_file(), "");
  } catch (const Error&) {
    // refused
  }
  return 0;
}
