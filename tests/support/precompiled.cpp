// Nothing: what is compiled here is the precompiled header of all tests.
int main() {}
