!> How report.html looks.
module report_style
   implicit none (type, external)
   private
   public :: page_style

   !> The style sheet.
   character(*), parameter :: page_style(*) = [character(124) :: &
      "<style>", &
      "body{font:15px/1.45 'DejaVu Sans',Verdana,sans-serif;margin:0 auto;max-width:1240px;padding:8px 20px 40px;color:#222}", &
      "h1{font-size:23px;margin:16px 0 4px}h2{font-size:18px;margin:30px 0 8px;border-bottom:1px solid #ccc}", &
      "h3{font-size:15px;margin:18px 0 4px;color:#444}", &
      ".status{font-weight:bold;color:#1f6fb4}.failed,.stopped{color:#b3261e}", &
      ".scroll{overflow-x:auto;max-height:70vh;overflow-y:auto}", &
      "table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}", &
      "th,td{padding:2px 10px;border-bottom:1px solid #e4e4e4;text-align:right;white-space:nowrap}", &
      "th:first-child,td:first-child,td.text,th.text{text-align:left}td.text{white-space:pre-wrap;max-width:60em}", &
      "thead th{position:sticky;top:0;background:#f4f6f8}", &
      "figure{display:inline-block;margin:6px 6px 14px 0;vertical-align:top;width:calc(50% - 12px)}", &
      "figure img{width:100%;border:1px solid #ddd}figcaption{font-size:13px;color:#555}", &
      "figure:has(iframe){width:100%}iframe{width:100%;height:820px;border:1px solid #ddd}", &
      "pre{font:12.5px/1.35 'DejaVu Sans Mono',monospace;overflow-x:auto;background:#f7f7f7;padding:10px}", &
      "summary{cursor:pointer;color:#1f6fb4}ul{margin:4px 0}#warnings+ul{color:#8a4b00}", &
      "@media print{.scroll{max-height:none;overflow:visible}figure{break-inside:avoid}}", &
      "</style>"]

end module report_style
