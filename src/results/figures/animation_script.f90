!> The text of a page that plays a mechanism: style, elements and script. The page has everything in it and asks no network.
!>
!> The script finds the data in `D` (`animation_page`). It projects the vertices of the outlines at each picture, draws SVG,
!> plays and
!> steps, turns a spatial scene where the mouse drags it, and beside it shows a clearance joint with its eccentricity magnified,
!> its path and
!> its force over the time.
module animation_script
   implicit none (type, external)
   private
   public :: page_head, page_script

   !> From the document's start to the data; the title comes between the first two lines and the rest.
   character(*), parameter :: page_head(*) = [character(124) :: &
      "<style>", &
      "body{font:15px 'DejaVu Sans',Verdana,sans-serif;margin:0;color:#222;background:#fff}", &
      "main{display:flex;flex-wrap:wrap;gap:12px;padding:0 16px}h1{font-size:19px;margin:12px 16px 4px}", &
      "svg{background:#fff;border:1px solid #ccc}#scene{flex:3 1 480px;height:72vh;min-height:320px;cursor:grab}", &
      "#side{flex:1 1 300px;max-width:420px}#side svg{width:100%;display:block;margin-bottom:8px}", &
      "nav{padding:8px 16px;display:flex;gap:8px;align-items:center;flex-wrap:wrap}", &
      "button,select{font:inherit;padding:3px 10px}input[type=range]{flex:1 1 200px}#time{min-width:9em}", &
      "p{margin:4px 16px;color:#555;font-size:13px}", &
      "</style></head><body>", &
      "<nav><button id='play'>play</button><button id='back' title='previous picture'>&#9664;</button>", &
      "", &
      "<button id='step' title='next picture'>&#9654;</button>", &
      "<input id='slider' type='range' min='0' value='0' aria-label='time'>", &
      "", &
      "<span id='time'></span><select id='view' aria-label='view'></select><select id='joint' aria-label='joint'></select></nav>", &
      "<main><svg id='scene'></svg><div id='side'><svg id='zoom' viewBox='0 0 400 420'></svg>", &
      "<svg id='force' viewBox='0 0 400 240'></svg></div></main><p id='legend'></p>", &
      "<script>"]

   !> From the data to the document's end.
   character(*), parameter :: page_script(*) = [character(124) :: &
      "const $=id=>document.getElementById(id),N=D.frames.length,S=D.size;let at=0,timer=0,az=-0.9,el=0.45,box=null;", &
      "const fixed={'x, y':[[1,0,0],[0,1,0]],'x, z':[[1,0,0],[0,0,1]],'y, z':[[0,1,0],[0,0,1]]};", &
      "const colours=['#1f6fb4','#2e8b57','#7b4fa3','#c98a00','#17a2b8','#8c564b','#5a6e1e','#3c3c78'];", &
      "const colour=b=>b?colours[(b-1)%8]:'#707070',dot=(a,b)=>a[0]*b[0]+a[1]*b[1]+a[2]*b[2];", &
      "const names=D.spatial?['3D',...Object.keys(fixed)]:['x, y'];", &
      "names.forEach(n=>$('view').add(new Option('view: '+n,n)));", &
      "D.loose.forEach((j,k)=>$('joint').add(new Option('joint: '+j.name,k)));", &
      "if(!D.loose.length){$('joint').hidden=true;$('side').hidden=true}if(!D.spatial)$('view').hidden=true;", &
      "$('slider').max=N-1;", &
      "function axes(){const v=$('view').value;if(fixed[v])return fixed[v];", &
      " return[[-Math.sin(az),Math.cos(az),0],[-Math.sin(el)*Math.cos(az),-Math.sin(el)*Math.sin(az),Math.cos(el)]]}", &
      "function world(f,b,s){const a=f.a,i=9*b,r=f.r,j=3*b;", &
      " return[0,1,2].map(k=>r[j+k]+a[i+k]*s[0]+a[i+3+k]*s[1]+a[i+6+k]*s[2])}", &
      "const flat=(V,x)=>[dot(V[0],x),-dot(V[1],x)],path=p=>p.map(q=>q[0].toPrecision(6)+','+q[1].toPrecision(6)).join(' ');", &
      "const line=(p,c,w,more)=>`<polyline points='${path(p)}' fill='none' stroke='${c}' stroke-width='${w*S}' ${more||''}/>`;", &
      "const disc=(p,r,c)=>`<circle cx='${p[0]}' cy='${p[1]}' r='${r}' fill='${c}", &
      "' stroke='#404040' stroke-width='${0.004*S}'/>`;", &
      "function measure(V){const x=[],y=[];D.frames.forEach(f=>{const take=(b,s)=>{const p=flat(V,world(f,b,s));", &
      "  x.push(p[0]);y.push(p[1])};D.parts.forEach(p=>p.s.forEach(s=>take(p.b,s)));", &
      "  D.marks.forEach(m=>m.s.forEach((s,k)=>(k||m.k!=7)&&take(m.b[k],s)))});", &
      " const lo=a=>a.reduce((u,v)=>Math.min(u,v),Infinity),hi=a=>a.reduce((u,v)=>Math.max(u,v),-Infinity),m=0.14*S;", &
      " return[lo(x)-m,lo(y)-m,hi(x)-lo(x)+2*m,hi(y)-lo(y)+2*m]}", &
      "function arrow(p,w){const n=Math.hypot(...w);if(n<1e-3*S)return'';const h=Math.min(0.03*S,0.5*n),u=[w[0]/n,w[1]/n];", &
      " const t=[p[0]+w[0],p[1]+w[1]],e=s=>[t[0]-h*u[0]-s*h*0.4*u[1],t[1]-h*u[1]+s*h*0.4*u[0]];", &
      " return line([p,t,e(1),t,e(-1)],'#d1495b',0.006)}", &
      "function ground(p){const h=0.035*S,y=p[1]+1.5*h;let s=line([[p[0]-h,y],p,[p[0]+h,y]],'#707070',0.003);", &
      " s+=line([[p[0]-1.5*h,y],[p[0]+1.5*h,y]],'#707070',0.003);for(let k=-1;k<2;k+=0.5)", &
      "  s+=line([[p[0]+k*1.4*h,y],[p[0]+(k-0.4)*1.4*h,y+0.6*h]],'#707070',0.002);return s}", &
      "function spring(a,b,c,n){const p=[a],d=[b[0]-a[0],b[1]-a[1]],l=Math.hypot(...d)||1;for(let k=0;k<n;k++){", &
      "  const u=0.15+0.7*k/(n-1),o=k&&k<n-1?c*(k%2?1:-1):0;p.push([a[0]+u*d[0]-o*d[1]/l,a[1]+u*d[1]+o*d[0]/l])}", &
      " return line([...p,b],'#404040',0.004)}", &
      "function damper(a,b,c){const d=[b[0]-a[0],b[1]-a[1]],l=Math.hypot(...d)||1,at=(u,o)=>[a[0]+u*d[0]-o*c*d[1]/l,", &
      "  a[1]+u*d[1]+o*c*d[0]/l];return[[a,at(0.25,0)],[at(0.75,1),at(0.25,1),at(0.25,-1),at(0.75,-1)],", &
      "  [at(0.55,0.8),at(0.55,-0.8)],[at(0.55,0),b]].map(p=>line(p,'#404040',0.004)).join('')}", &
      "function wall(p,q,h){const d=[q[0]-p[0],q[1]-p[1]],l=Math.hypot(...d);if(!l)return'';const u=[d[0]/l,d[1]/l];", &
      " const e=k=>[p[0]-k*h*u[1],p[1]+k*h*u[0]];let s=line([e(-1),e(1)],'#707070',0.003);", &
      " for(let k=-1;k<=1;k+=0.4){const b=e(k);", &
      "  s+=line([b,[b[0]-0.4*h*(u[0]-u[1]),b[1]-0.4*h*(u[1]+u[0])]],'#707070',0.002)}return s}", &
      "function guide(p,u,w,h,fixed){const n=[-u[1],u[0]],l=Math.hypot(...n);if(l<0.1)return'';let s='';[-1,1].forEach(k=>{", &
      "  const g=k*h[k<0?0:1],o=[g*n[0]/l,g*n[1]/l],e=t=>[p[0]+t*u[0]+o[0],p[1]+t*u[1]+o[1]],a=w[0]-0.09*S,b=w[1]+0.09*S;", &
      "  s+=line([e(a),e(b)],'#707070',0.003);for(let t=a;fixed&&t<b;t+=0.02*S){const q=e(t);", &
      "   s+=line([q,[q[0]+0.017*S*k*n[0]/l-0.012*S*u[0],q[1]+0.017*S*k*n[1]/l-0.012*S*u[1]]],'#707070',0.002)}});return s}", &
      "function plane(p,u,w){const a=w[0]-0.2*S,b=w[1]+0.2*S,e=t=>[p[0]+t*u[0],p[1]+t*u[1]];", &
      " let s=line([e(a),e(b)],'#707070',0.003);for(let t=a;t<b;t+=0.02*S){const q=e(t);", &
      "  s+=line([q,[q[0]-0.015*S*(u[0]+u[1]),q[1]-0.015*S*(u[1]-u[0])]],'#707070',0.002)}return s}", &
      "function mark(V,f,m){const p=m.s.map((s,k)=>flat(V,world(f,m.b[k],s)));let s='';const stand=()=>{", &
      "  const k=m.b.indexOf(0);return k<0?'':ground(p[k])};", &
      " if(m.k==1)s+=stand()+disc(p[1],0.014*S,'#fff');if(m.k==3)s+=stand()+line(p,'#404040',0.004)+p.map(q=>disc(q,0.014*S,", &
      "'#fff')).join('');", &
      " if(m.k==4||m.k==8)s+=m.b.map((b,k)=>b?'':wall(p[k],p[1-k],2*m.c)).join('')", &
      "  +(m.k==4?spring(...p,m.c,m.z):damper(...p,m.c));", &
      " if(m.k==2){const o=world(f,m.b[0],m.s[0]),e=world(f,m.b[0],m.s[0].map((v,k)=>v+m.a[k]));", &
      "  s+=guide(p[0],flat(V,e.map((v,k)=>v-o[k])),m.w,m.h,!m.b[0])}", &
      " if(m.k==7){const o=world(f,m.b[0],m.s[0]),e=world(f,m.b[0],m.s[0].map((v,k)=>v+m.a[k]));", &
      "  const n=flat(V,e.map((v,k)=>v-o[k])),l=Math.hypot(...n);if(l>0.1)s+=plane(p[0],[-n[1]/l,n[0]/l],m.w)}", &
      " if(m.k==5){const e=m.l?flat(V,f.e[m.l-1]):[0,0],g=D.magnified;s+=stand()+disc(p[0],0.034*S,'#fff4d6')", &
      "  +disc([p[0][0]+g*e[0],p[0][1]+g*e[1]],0.021*S,'#9fb4c7')}", &
      " if((m.l||m.q)&&D.force)s+=arrow(p[1],flat(V,m.l?f.f[m.l-1]:f.g[m.q-1]).map(v=>v*0.25*S/D.force));return s}", &
      "function scene(){const V=axes(),f=D.frames[at];let s='',t='';if(!box)box=measure(V);D.parts.forEach(p=>{", &
      "  const q=p.s.map(v=>flat(V,world(f,p.b,v)));p.k.forEach(k=>{const g=k.v.map(i=>q[i]);if(k.f)t+=", &
      "   `<polygon points='${path(g)}' fill='${colour(p.b)}' fill-opacity='0.12' stroke='${colour(p.b)}", &
      "' stroke-width='${0.007*S}'/>`;", &
      "   else t+=line(g,colour(p.b),0.009,`stroke-linecap='round'`)})});D.marks.forEach(m=>s+=mark(V,f,m));", &
      " $('scene').setAttribute('viewBox',box.join(' '));$('scene').innerHTML=t+s}", &
      "function slide(V,f,m,J,text){const way=(b,x)=>flat(V,world({r:f.r.map(()=>0),a:f.a},b,x)),u=way(m.b[0],m.a);", &
      " const v=way(m.b[1],m.aj),l=Math.hypot(...u),w=Math.hypot(...v),n=[u[1]/l,-u[0]/l],e=flat(V,f.e[m.l-1]);", &
      " if(l<0.3||w<0.3)return text(6,16,J.name+': seen along its axis');", &
      " const g=55/Math.max(...m.g),tilt=(n[0]*v[0]+n[1]*v[1])/w*m.n*g*Math.sign(u[0]*v[0]+u[1]*v[1]),o=g*(n[0]*e[0]+n[1]*e[1]);", &
      " const box=p=>`<polygon points='${path(p)}' fill='#9fb4c7' stroke='#404040'/>`,a=138-o+tilt,b=138-o-tilt;", &
      " const side=(y,h)=>`<rect x='0' y='${Math.min(y,y+h)}' width='400' height='30' fill='#ddd'/>", &
      "<path d='M0 ${y}H400' stroke='#404040'/>`;", &
      " return side(138-g*m.g[0],-30)+side(278+g*m.g[1],30)+text(6,16,J.name)", &
      "  +box([[70,a],[330,b],[330,b+140],[70,a+140]])", &
      "  +text(394,16,'gaps '+unit(m.g[0],'m')+', '+unit(m.g[1],'m'),'end')", &
      "  +text(200,412,'clearance and tilt magnified','middle')}", &
      "function zoom(){const J=D.loose[+$('joint').value];if(!J)return;const k=+$('joint').value,V=axes(),T=D.track;", &
      " const text=(x,y,w,a)=>`<text x='${x}' y='${y}' font-size='13' text-anchor='${a||'start'}' fill='#333'>${w}</text>`;", &
      " const m=D.marks.find(m=>m.k==2&&m.l==k+1&&m.n>0);", &
      " if(J.c>0){const big=T.e[k].reduce((u,v)=>Math.max(u,Math.hypot(...v)),J.c),g=130/big,R=185,r=R-J.c*g;", &
      "  const c=(x,y,q,fill)=>`<circle cx='${x}' cy='${y}' r='${q}' fill='${fill}' stroke='#404040'/>`;", &
      "  const e=flat(V,D.frames[at].e[k]).map(v=>v*g),now=D.frames[at].t;", &
      "const p=T.e[k].filter((v,i)=>T.t[i]<=now).slice(-400);", &
      "  $('zoom').innerHTML=c(200,208,R,'#fff4d6')+c(200+e[0],208+e[1],r,'#9fb4c7')+`<polyline points='${path(p.map(v=>{", &
      "   const q=flat(V,v);return[200+g*q[0],208+g*q[1]]}))}' fill='none' stroke='#d1495b'/>`+", &
      "   c(200+e[0],208+e[1],4,'#d1495b')+text(6,16,J.name)+text(394,16,'clearance '+J.cw,'end')+", &
      "   text(200,412,'journal path (journal drawn smaller)','middle')}", &
      " else $('zoom').innerHTML=m?slide(V,D.frames[at],m,J,text):text(6,16,J.name+': see the view at the left');", &
      " const F=T.f[k],top=F.reduce((u,v)=>Math.max(u,v),0)||1,t0=T.t[0],t1=T.t[T.t.length-1];", &
      " const X=t=>45+345*(t-t0)/(t1-t0||1),Y=f=>200-170*f/top,now=D.frames[at].t;", &
      " $('force').innerHTML=`<polyline points='${path(F.map((v,i)=>[X(T.t[i]),Y(v)]))}' fill='none' stroke='#1f6fb4'/>`", &
      "  +`<path d='M45 200H390M45 200V25' stroke='#404040' fill='none'/><path d='M${X(now)} 25V200' stroke='#d1495b'/>`", &
      "  +text(45,18,'force, maximum '+unit(top,'N'))+text(45,218,unit(t0,'s'))+text(390,218,unit(t1,'s'),'end')}", &
      "function unit(x,u){const a=Math.abs(x);const[n,f]=a>=1e6?['M',1e-6]:a>=1e3?['k',1e-3]:a>=1||a==0?['',", &
      "1]:a>=1e-3?['m',1e3]:", &
      " ['\u00b5',1e6];return+(x*f).toPrecision(4)+' '+n+u}", &
      "function show(k){at=(k+N)%N;$('slider').value=at;$('time').textContent='t = '+unit(D.frames[at].t,'s');scene();zoom()}", &
      "function stop(){clearInterval(timer);timer=0;$('play').textContent='play'}", &
      "$('play').onclick=()=>{if(timer)return stop();$('play').textContent='stop';timer=setInterval(()=>show(at+1),6000/N)};", &
      "$('step').onclick=()=>{stop();show(at+1)};$('back').onclick=()=>{stop();show(at-1)};", &
      "$('slider').oninput=e=>{stop();show(+e.target.value)};$('joint').onchange=()=>show(at);", &
      "$('view').onchange=()=>{box=null;show(at)};", &
      "$('scene').onmousemove=e=>{if(!D.spatial||!(e.buttons&1))return;$('view').value='3D';az-=0.01*e.movementX;", &
      " el=Math.max(-1.5,Math.min(1.5,el+0.01*e.movementY));const c=measure(axes());box=c;show(at)};", &
      "$('scene').onwheel=e=>{e.preventDefault();const z=e.deltaY>0?1.15:1/1.15,b=box;", &
      " box=[b[0]+b[2]*(1-z)/2,b[1]+b[3]*(1-z)/2,b[2]*z,b[3]*z];scene()};", &
      "document.onkeydown=e=>{if(e.key=='ArrowRight')$('step').click();if(e.key=='ArrowLeft')$('back').click()};", &
      "$('legend').textContent=D.legend+(D.spatial?'; drag: rotate':'')+", &
      " '; wheel: zoom; arrow keys: step';show(0);", &
      "</script></body></html>"]

end module animation_script
