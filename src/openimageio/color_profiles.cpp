#include <OpenImageIO/tiffutils.h>

#include <cstdint>
#include <string>

// OpenImageIO calls this for the colour profile in a file of any format, which nothing here uses.
// Its own, in version 2.4, reads where a damaged profile says, also far outside of it. The loader
// looks into this module before the libraries that come with it.
OIIO_NAMESPACE_BEGIN

bool decode_icc_profile(cspan<std::uint8_t>, ImageSpec&, std::string&) {
  return true;
}

OIIO_NAMESPACE_END
