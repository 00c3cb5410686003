// SPDX-License-Identifier: MIT
// What libc++abi of this system lacks, for the npm package and for tests: destructors of thread-local objects run when
// their thread ends. There is one thread, which never ends.
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*);
extern "C" int __cxa_thread_atexit(void (* /*destroy*/)(void*), void* /*object*/, void* /*library*/) { return 0; }
