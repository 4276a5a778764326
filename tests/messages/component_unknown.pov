// mistake in line 3: a component that vectors lack
#declare V = <1, 2, 3>;
#declare A = V.w;
