#pragma once

#ifdef __cplusplus
extern "C" {
#endif

int draws_with_the_old_header_name(const char* scene_text);

#ifdef __cplusplus
}
#endif
