// mistake in line 2: an entity of HTML after which a name is missing
#if (1 &amp; 1) sphere { 0, 1 pigment { rgb 1 } } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
