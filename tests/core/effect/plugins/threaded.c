/* SPDX-License-Identifier: MIT
 *
 * plain.c with a thread that starts when it is loaded and never ends. -DFAULT_... makes the
 * registry refuse it. */
#include <pthread.h>
#include <time.h>

#include "plain.c"

static void* work(void* unused) {
  const struct timespec pause = {0, 1000000};
  (void)unused;
  for (;;) nanosleep(&pause, NULL);
  return NULL;
}

__attribute__((constructor)) static void startThread(void) {
  pthread_t thread;
  if (pthread_create(&thread, NULL, work, NULL) == 0) pthread_detach(thread);
}
