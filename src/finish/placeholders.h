#pragma once

#include <string>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// The text with its placeholders replaced, in the way of Python's and fmt's format strings:
//   {time}          time of the snapshot, as its header has it
//   {redshift}      redshift
//   {scale_factor}  1 / (1 + redshift)
//   {frame}         number of a film's frame, 0 for a single picture
//   {snapshot}      name of the snapshot's file
// A format may follow the name: {redshift:.2f}, {frame:04}. {{ and }} are braces.
// `key` names the scene's key in messages. Throws UsageError for placeholders that are
// unknown or have no value.
std::string replace_placeholders(const std::string& text, const SnapshotInfo& snapshot, int frame,
                                 const std::string& key);

}  // namespace splotchcl
