// A shared library that is no plug-in.
extern "C" int not_seif_plugin() { return 0; }
