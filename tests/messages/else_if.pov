// mistake in line 5: `#else if` for `#elseif`
#declare A = 2;
#if (A = 1)
  sphere { 0, 1 }
#else if (A = 2)
  sphere { 0, 2 }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
