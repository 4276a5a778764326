// mistake in line 2: a type, which is a function of scenes, for `#declare`
int Count = 2;
