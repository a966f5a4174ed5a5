#pragma once

#include <unistd.h>

namespace twin::test {

/// The process without root's rights as long as this lives.
class AsNobody {
 public:
  AsNobody() : user_(::geteuid()), is_changed_(user_ == 0 && ::seteuid(65534) == 0) {}
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;
  ~AsNobody() {
    if (is_changed_ && ::seteuid(user_) != 0) {
      ::_exit(3);
    }
  }

 private:
  uid_t user_;
  bool is_changed_;
};

}  // namespace twin::test
