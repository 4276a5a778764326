// mistake in line 2: `<>` for `!=`
#if (1 <> 2) sphere { 0, 1 } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
