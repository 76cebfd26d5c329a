#include "sequence/sequence_member.h"

#include "snapshot/field_names.h"

namespace splotchcl {

Column SequenceMember::read(int type, const std::string& field) const {
  const TypeField key = {type, require_field(info(), type, field).name};
  const std::lock_guard lock(mutex_);
  const auto found = columns_.find(key);
  if (found != columns_.end()) return found->second;
  return columns_[key] = snapshot_->read(type, field);
}

std::set<TypeField> SequenceMember::fields_read() const {
  const std::lock_guard lock(mutex_);
  std::set<TypeField> fields;
  for (const auto& [field, column] : columns_)
    fields.insert(field);
  return fields;
}

}  // namespace splotchcl
